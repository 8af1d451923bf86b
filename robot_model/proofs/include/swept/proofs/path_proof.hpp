// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/path_certificate.hpp"
#include "swept/robot_model/task_constraint.hpp"
#include "swept/robot_model/tool_line.hpp"
#include "swept/robot_model/tracking_tolerance.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

/// Proofs of paths and trajectories in files that others can check, with `swept verify` or
/// verifyProof(). Both run the code of robot_model/verify, which shares nothing with the code that
/// finds proofs.
namespace swept {

/// The result of writing a proof.
struct WrittenProof {
  /// The place where no separating planes were found, `segment 3, forearm - shelf`, or the
  /// constraint that the file would not show, `segment 3, axis of hand`. Then there is no file.
  /// Empty: the file is written.
  std::string missing;

  bool isWritten() const { return missing.empty(); }  ///< whether the file is written
};

/// Finds planes that separate all pairs of bodies during the motions between `states`. Writes them
/// with the path, the robot and the world, bit for bit, to a `.json` file that can be checked
/// without any other file. The file is written completely or not at all. `certificate`: the result
/// of certifyPath() for the same states, with clearances. `warnings`: lines about what is not
/// checked, which the reader of the file sees again (LoadOptions::warnOfUnchecked). The planes
/// hold wherever CheckerOptions::tracking lets the robot be. The constraints of the checker are in
/// the file, and need no planes: whoever checks it proves them from the states. Looking for planes
/// ends soon after `stop` is requested, and no file is written.
///
/// Throws UsageError for a path that is not Free, a world with moving obstacles (a path has no
/// times; writeTrajectoryProof() takes them), names that are not UTF-8, a file that cannot be
/// written or has another extension, and a proof that is larger than readable files
/// (kMaxTextBytes); std::invalid_argument for a certificate with another number of segments, or
/// without clearances; SearchStopped for `stop`.
WrittenProof writeProof(const std::filesystem::path& file, const Checker& checker,
                        const ConfigurationList& states, const PathCertificate& certificate,
                        const std::vector<std::string>& warnings = {},
                        const std::stop_token& stop = {});

/// The same for a trajectory: for the curve that controllerCurve() makes of it, from its first
/// point to its last. A start that is no point of it is not part of the file. `certificate`: the
/// result of certifyTrajectory() for that curve, with clearances. Moving obstacles are in the file
/// with their waypoints, and one more in the middle of a turn by about half a turn, which tells
/// which way round. The planes hold beside them. `clock`: s, TrajectoryQuery::clock of the
/// certificate.
///
/// Throws UsageError as writeProof() does but for moving obstacles, for a curve that leaves the
/// limits of a position, and for an obstacle that turns by about half a turn between two times
/// without another number between them; std::invalid_argument for a trajectory that
/// controllerCurve() refuses, variables other than the group's in its order, a certificate that
/// ends at another time, or one without clearances; SearchStopped for `stop`.
WrittenProof writeTrajectoryProof(const std::filesystem::path& file, const Checker& checker,
                                  const JointTrajectory& trajectory,
                                  const TrajectoryCertificate& certificate,
                                  const std::vector<std::string>& warnings = {}, double clock = 0.0,
                                  const std::stop_token& stop = {});

/// The same for lines of a ToolLinePlanner, one after the other, each of which begins where the one
/// before ends: for the straight motions between their way points. The file also says, and whoever
/// checks it shows, that `tool` keeps within `options` of its lines at every instant, as
/// ToolLineOptions says: of the motions themselves, without CheckerOptions::tracking. A line that
/// is not complete is shown as far as its way points go.
///
/// Throws UsageError as writeProof() does; std::invalid_argument for no line, and for one that does
/// not begin where the one before ends; SearchStopped for `stop`.
WrittenProof writeLineProof(const std::filesystem::path& file, const Checker& checker,
                            const ConstraintFrame& tool, std::span<const ToolLine> lines,
                            const ToolLineOptions& options = {},
                            const std::vector<std::string>& warnings = {},
                            const std::stop_token& stop = {});

/// The result of checking a proof.
struct CheckedProof {
  /// The first place where it does not hold, or what was changed. Empty: it holds, and the other
  /// members are meaningful.
  std::string refusal;
  std::size_t segments = 0;   ///< of the path, or pieces of the trajectory
  std::size_t pairs = 0;      ///< of bodies that must stay apart
  std::size_t intervals = 0;  ///< of all pairs and segments
  std::size_t planes = 0;     ///< likewise
  ///@{
  /// m. Every pair keeps more than `clearance`, pairs with the world more than `clearanceWorld`,
  /// pairs of the robot's own bodies more than `clearanceSelf`; infinity: there are none.
  double clearance = 0.0, clearanceWorld = 0.0, clearanceSelf = 0.0;
  ///@}
  /// Pairs that may touch and were not checked (`a - b`), by who says so.
  std::map<std::string, std::vector<std::string>> notChecked;
  /// s, between the first point and the last. Without a value the proof is not of a trajectory but
  /// of the straight motions between states.
  std::optional<double> duration = {};
  /// How far each joint of the group may be off, by name: all this holds wherever it is within
  /// that. Empty: it holds of the path or trajectory itself.
  std::map<std::string, JointTolerance> tube = {};
  /// What holds at every instant besides, in words: `axis (0, 0, 1) of hand within 0.0873 rad of
  /// (0, 0, 1)`.
  std::vector<std::string> constraints = {};
  /// Names of moving obstacles: the pairs keep apart from them, too, on their clock.
  std::vector<std::string> moving = {};
  ///@{
  /// s. What the clock shows at the first and at the last point; 0 if nothing moves.
  double clockBegin = 0.0, clockEnd = 0.0;
  ///@}

  bool holds() const { return refusal.empty(); }  ///< whether the file's claims are proven
};

/// Checks the proof of a path file against the robot and the world in it. The file must come from
/// writeProof(), writeTrajectoryProof(), `swept plan --embed` or `swept certify --embed`. Throws
/// InputError for a file that is no path with a proof, or has no robot and world, and SearchStopped
/// soon after `stop` is requested.
CheckedProof verifyProof(const std::filesystem::path& file, const std::stop_token& stop = {});

/// The same for any path file with a proof; also checks that robot, world and rules are those of
/// `checker`, and that the file shows its constraints, if it has any.
CheckedProof verifyProof(const std::filesystem::path& file, const Checker& checker,
                         const std::stop_token& stop = {});

}  // namespace swept
