// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "swept/robot_model/input.hpp"

namespace swept {

/// From where to where, in the layout of moveit_msgs/MotionPlanRequest.
struct PlanningRequest {
  using JointValues = std::vector<std::pair<std::string, double>>;  ///< rad or m, by joint
  /// Where a link's frame is to be.
  struct PoseGoal {
    std::string link;                   ///< whose frame
    Eigen::Isometry3d model_from_link;  ///< wanted
    double positionTolerance;           ///< m: radius of a ball, or half the least side of a box
    double orientationTolerance;        ///< rad: the least of the three about the axes
  };
  std::string group;                ///< empty: the request does not say
  JointValues start;                ///< of the start state; may have joints outside the group
  std::vector<JointValues> goals;   ///< each may be reached
  std::vector<PoseGoal> poseGoals;  ///< likewise

  /// Reads a YAML file. Tolerances of joint goals are left out: their values are reached. Throws
  /// InputError for what it lacks (a start, a goal), and for a goal that is neither joint values
  /// nor a link's position and orientation.
  static PlanningRequest load(const std::filesystem::path& yaml, const LoadOptions& options = {});
};

}  // namespace swept
