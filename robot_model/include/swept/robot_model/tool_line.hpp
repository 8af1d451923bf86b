// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/checker_results.hpp"
#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/task_constraint.hpp"

/// Straight motions of a tool, proven at every instant.
namespace swept {

namespace detail {
struct LineModel;
}

/// How far a tool may be off its line, and how hard ToolLinePlanner tries.
///
/// The straight motion of a tool, by the share s in [0, 1] of it: the tool's origin is at
/// p0 + s (p1 - p0), and its orientation is slerp(R0, R1, s), along the shorter arc. A path follows
/// it in chords, which are straight motions of the joints (as Checker::certifyMotion() has them)
/// between way points at shares s0 < s1. At every instant t in [0, 1] of a chord
///
/// * the tool's origin is within `position` of the segment between the line's points at s0 and s1;
/// * its orientation is within `angle` of the line's at the share s0 + t (s1 - s0).
///
/// So it never leaves the line by more, nor goes back by more than a chord and `position`.
struct ToolLineOptions {
  double position = 1e-3;                         ///< m, above 0
  double angle = 0.5 * std::numbers::pi / 180.0;  ///< rad, above 0; pi and more: any orientation
  /// m along the line, or rad of the tool's turn if these are more. A chord so short that cannot be
  /// proven ends the path.
  double leastStep = 1e-5;
  int maxWayPoints = 10'000;  ///< a longer path ends as Undecided; 2 at least
  /// Once it is requested, by any thread, the path ends as Undecided, with what is proven by then.
  std::stop_token stop = {};
};

/// Why a path does not follow its line to the end.
struct ToolLineStop {
  /// What is in the way.
  enum class Reason : std::uint8_t {
    Limit,        ///< a variable would have to leave its limits; or the start is outside them
    Singularity,  ///< near a singular configuration joints had to jump, or the line leads out of
                  ///< reach
    Jump,         ///< only joints that jump get the tool farther along the line
    Unreachable,  ///< the group cannot move the tool in this direction at all
    Contact,      ///< with a witness
    Violation,    ///< of CheckerOptions::constraints
    Undecided,  ///< freedom, or these constraints, could not be proven; or too many way points, or
                ///< ToolLineOptions::stop
  };
  Reason reason = Reason::Undecided;  ///< see there
  double share = 0.0;  ///< of the line, in [0, 1]: where that is, at or beyond ToolLine::share
  /// Limit: the name of the variable; empty otherwise.
  std::string variable = {};
  /// Limit, Singularity, Jump, Unreachable: the least singular value of the tool's Jacobian at the
  /// last way point (m or rad per rad or m of joints; without the rows of the orientation if any is
  /// allowed); 0 otherwise.
  double leastSingularValue = 0.0;
  /// Singularity, Jump: by how much the variable that changes most would have to, per m (of a line
  /// without length: per rad) of the tool's motion (rad or m), as far as a solution was found; 0
  /// otherwise, or without one.
  double jointStep = 0.0;
  /// Contact: the first one. `t` is the share of the line.
  std::optional<Witness> contact = {};
  /// Violation: the earliest. `t` is the share of the line.
  std::optional<ConstraintViolation> violation = {};
};

/// The part of a tool's straight motion that is proven, as a path of the group.
struct ToolLine {
  Eigen::Isometry3d model_from_start = Eigen::Isometry3d::Identity();  ///< the tool at the start
  Eigen::Isometry3d model_from_goal = Eigen::Isometry3d::Identity();   ///< as given
  double length = 0.0;                                                 ///< m, between their origins
  double turn = 0.0;  ///< rad in [0, pi], between their orientations
  /// The largest proven part is [0, share]. 1: all of it; the last way point is then at the goal
  /// to within 1e-6 m and rad.
  double share = 0.0;
  std::vector<std::vector<double>> wayPoints;  ///< the first is the start, the last is at `share`
  std::vector<double> shares;                  ///< of the way points, increasing
  double position = 0.0;             ///< m, proven: the tool's origin is never farther off
  double angle = 0.0;                ///< rad, likewise of its orientation; 0 if any is allowed
  std::optional<ToolLineStop> stop;  ///< present exactly if the share is less than 1
  int solved = 0;                    ///< effort: calls of InverseKinematics::solve()

  bool complete() const { return !stop; }  ///< whether all of the line is proven
};

/// Follows straight lines with a tool, a frame that is fixed in a link or an attached body.
///
/// Way points are found by inverse kinematics from the one before (InverseKinematics, which keeps
/// limits), as far apart as the curvature of the tool's way allows. Each chord is proven to keep
/// the tool within its deviation (see ToolLineOptions) and free by Checker::certifyMotion(),
/// rounding included. A redundant arm moves by the least joint motion. The deviation is that of the
/// motion itself: CheckerOptions::tracking says what is free beside it, and adds to it. Immutable,
/// for any number of threads.
class ToolLinePlanner {
 public:
  /// Throws std::invalid_argument for null, a world with moving obstacles, an unknown link or
  /// attached body, the model frame, a frame that is not rigid, and a link that the group does not
  /// move.
  ToolLinePlanner(std::shared_ptr<const Checker> checker, const ConstraintFrame& tool);

  /// As given.
  const Checker& checker() const;
  /// Pose of the tool: model_from_tool. Throws as InverseKinematics::pose() does.
  Eigen::Isometry3d pose(ConfigurationView q) const;

  /// The straight motion from the tool's pose at `start` to `goal` (model_from_tool). The same
  /// arguments give the same path. Throws std::invalid_argument for a goal that is not a rigid
  /// transform, for options out of their ranges, and as pose() does for the start. A start that is
  /// outside its limits or in contact is no error: the share is then 0.
  ToolLine plan(ConfigurationView start, const Eigen::Isometry3d& goal, Workspace& workspace,
                const ToolLineOptions& options = {}) const;

 private:
  std::shared_ptr<const detail::LineModel> model_;
};

/// `limit`, `singularity`, `jump`, `unreachable`, `contact`, `violation` or `undecided`.
std::string toString(ToolLineStop::Reason reason);
/// `contact: hand - shelf at 0.42 of the line, at [0.5 0 0.3]`: the reason in words.
std::string describe(const ToolLineStop& stop, const TaskConstraint& constraints);

}  // namespace swept
