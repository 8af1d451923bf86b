// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "swept/robot_model/attached_body.hpp"
#include "swept/robot_model/collision_rules.hpp"
#include "swept/robot_model/input.hpp"

namespace swept {

class Robot;

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
  /// Where a joint of several values, such as a mobile base's virtual joint, has its child.
  struct BasePose {
    std::string joint;                    ///< planar or floating
    Eigen::Isometry3d parent_from_child;  ///< in the frame that the joint hangs on
  };
  std::string group;                ///< empty: the request does not say
  JointValues start;                ///< of the start state; may have joints outside the group
  std::vector<BasePose> bases;      ///< of the start state: its `multi_dof_joint_state`
  std::vector<JointValues> goals;   ///< each may be reached
  std::vector<PoseGoal> poseGoals;  ///< likewise
  /// m, model frame: where bases may go, as MoveIt has it (planar and floating joints' positions).
  std::optional<Eigen::AlignedBox3d> workspace = {};
  std::vector<AttachedBody> attached = {};  ///< of the start state, at links
  CollisionRules rules = {};                ///< of attached bodies that may touch each other

  /// Reads a YAML file. Tolerances of joint goals are left out: their values are reached. Throws
  /// InputError for what it lacks (a start, a goal), for a goal that is neither joint values nor a
  /// link's position and orientation, for keys that are unknown or given twice, for frames that are
  /// not the model frame, and for what would be left out: constraints of the path, attached
  /// objects.
  static PlanningRequest load(const std::filesystem::path& yaml, const LoadOptions& options = {});
  /// For a robot: attached objects are read, whose poses are in the frame of their link, and goals
  /// may be in frames of links that no joint moves. Throws InputError, too, for joints and links
  /// that the robot does not have, and a value of a joint that mimics another which is not the one
  /// that it has.
  static PlanningRequest load(const std::filesystem::path& yaml, const Robot& robot,
                              const LoadOptions& options = {});

  /// `start` with the values of `bases`, by the robot's names (`base/x`, `base/rot_w`). Throws
  /// std::invalid_argument for a base that is moved and that the robot does not have, or not as a
  /// planar or floating joint; and for one that leaves its plane.
  JointValues startOf(const Robot& robot) const;
};

}  // namespace swept
