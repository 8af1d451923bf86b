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
#include "swept/robot_model/task_constraint.hpp"

namespace swept {

class Robot;

/// A start and goals, in the layout of moveit_msgs/MotionPlanRequest.
struct PlanningRequest {
  using JointValues = std::vector<std::pair<std::string, double>>;  ///< rad or m, by joint
  /// A goal pose of a link's frame.
  struct PoseGoal {
    std::string link;                   ///< whose frame
    Eigen::Isometry3d model_from_link;  ///< the goal pose
    double positionTolerance;           ///< m: radius of a ball, or half the least side of a box
    double orientationTolerance;        ///< rad: the least of the three about the axes
  };
  /// The pose that a joint of several values, such as a mobile base's virtual joint, gives its
  /// child link.
  struct BasePose {
    std::string joint;                    ///< planar or floating
    Eigen::Isometry3d parent_from_child;  ///< in the parent frame of the joint
  };
  std::string group;                ///< empty: the request names none
  JointValues start;                ///< of the start state; may have joints outside the group
  std::vector<BasePose> bases;      ///< of the start state: its `multi_dof_joint_state`
  std::vector<JointValues> goals;   ///< the planner may reach any of them
  std::vector<PoseGoal> poseGoals;  ///< likewise
  /// m, model frame: the space for bases (positions of planar and floating joints), as in MoveIt.
  std::optional<Eigen::AlignedBox3d> workspace = {};
  std::vector<AttachedBody> attached = {};  ///< of the start state, in their links' frames
  CollisionRules rules = {};                ///< allow attached bodies that may touch each other
  TaskConstraint pathConstraints = {};      ///< what the whole path has to keep

  /// Reads a YAML file. Tolerances of joint goals are ignored: the path reaches their values.
  /// Throws InputError for a missing start or goal, for a goal that is neither joint values nor a
  /// link's position and orientation, for keys that are unknown or given twice, for frames that are
  /// not the model frame, and for content that it cannot keep: without a robot constraints of the
  /// path and attached objects.
  static PlanningRequest load(const std::filesystem::path& yaml, const LoadOptions& options = {});
  /// The same for a robot. It also reads attached objects, whose poses are in the frame of their
  /// link, goals in frames of links that no joint moves, and `path_constraints` in frames of any
  /// link or attached object. Throws InputError, too, for joints and links that the robot lacks,
  /// for constraints that cannot be kept, and for a mimicking joint with a value that does not
  /// follow its master.
  static PlanningRequest load(const std::filesystem::path& yaml, const Robot& robot,
                              const LoadOptions& options = {});

  /// `start` with the values of `bases`, by the robot's names (`base/x`, `base/rot_w`). Throws
  /// std::invalid_argument for a moved base that the robot does not have as a planar or floating
  /// joint, and for one that leaves its plane.
  JointValues startOf(const Robot& robot) const;
};

}  // namespace swept
