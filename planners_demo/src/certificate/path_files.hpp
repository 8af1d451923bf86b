// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "certificate/certificate.hpp"
#include "certificate/path_json.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

namespace swept {

/// By its ending.
bool isYaml(const std::filesystem::path& file);

/// Where a path or a trajectory goes and in which format; made before planning, so that a name that
/// cannot work is refused at once.
class PathFile {
 public:
  /// What goes there. Names of a trajectory's YAML file may be those of variables (`base/x`).
  enum class Content { Path, Trajectory };

  /// Throws UsageError for an unknown ending, a folder that is missing or not writable, a name that
  /// is a folder, for a group that the format cannot hold, and for names of the robot that
  /// are not UTF-8, where the format has to be.
  PathFile(const std::string& file, const Robot& robot, const Group& group,
           Content content = Content::Path);

  /// Whether it holds a proof: the format has a place for one.
  bool holdsProof() const;
  /// Throws UsageError for the first name in `inputs`, or of what is checked, that is not UTF-8, if
  /// the file holds a proof.
  void requireNames(const Json& inputs, const Checker& checker) const;
  /// The file appears whole or not at all. All but the states, or the trajectory, is for what holds
  /// a proof. Throws UsageError naming file and reason: also for other names that are not UTF-8.
  void write(const Checker& checker, const PathRecord& record, const Certificate& certificate,
             bool embed) const;

 private:
  std::filesystem::path file_;
};

/// What a file holds of a path or a trajectory.
struct PathProof {
  ProvenPath path;          ///< or a trajectory's points
  Certificate certificate;  ///< planes beside the path, or beside the trajectory's curve
};
/// Of a trajectory. `certificate`: of its curve, which is free, with clearances. `clock`: s, its
/// TrajectoryQuery::clock.
PathProof proofOf(const Checker& checker, const JointTrajectory& trajectory,
                  const TrajectoryCertificate& certificate, double clock = 0.0);

}  // namespace swept
