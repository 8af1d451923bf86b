// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>

#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/planning_request.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {
namespace {

constexpr double kPlane = 1e-6;  // m, and of an axis: rounding of what a program has written

[[noreturn]] void refuse(const PlanningRequest::BasePose& base, const std::string& reason) {
  throw std::invalid_argument("multi_dof_joint_state of '" + base.joint + "': " + reason);
}

/// x, y, theta, in the plane of an SRDF's virtual joint, which is that of x and y.
std::array<double, 3> planarValues(const PlanningRequest::BasePose& base, const Joint& joint) {
  if (joint.axis != Eigen::Vector3d::UnitZ())
    refuse(base, "only a planar joint whose axis is z can be given so");
  const Eigen::Isometry3d& pose = base.parent_from_child;
  const Eigen::Matrix3d& turn = pose.linear();
  const bool upright = (turn.col(2) - Eigen::Vector3d::UnitZ()).norm() <= kPlane;
  if (!upright || !(std::abs(pose.translation().z()) <= kPlane))
    refuse(base, "the joint is planar, and the pose is not in its plane");
  return {pose.translation().x(), pose.translation().y(), std::atan2(turn(1, 0), turn(0, 0))};
}

std::array<double, 7> floatingValues(const PlanningRequest::BasePose& base) {
  const Eigen::Vector3d p = base.parent_from_child.translation();
  const Eigen::Quaterniond q(base.parent_from_child.linear());
  return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

void addValues(const Robot& robot, const Joint& joint, std::span<const double> values,
               PlanningRequest::JointValues& start) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t variable = static_cast<std::size_t>(joint.firstVariable) + i;
    start.emplace_back(robot.variables()[variable].name, values[i]);
  }
}

}  // namespace

PlanningRequest::JointValues PlanningRequest::startOf(const Robot& robot) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return startOf(robot); });
  }
  JointValues values = start;
  for (const BasePose& base : bases) {
    const std::optional<int> index = robot.findJoint(base.joint);
    const JointType type = index ? robot.joints()[*index].type : JointType::Fixed;
    if (type == JointType::Planar) {
      const Joint& joint = robot.joints()[*index];
      addValues(robot, joint, planarValues(base, joint), values);
    } else if (type == JointType::Floating) {
      addValues(robot, robot.joints()[*index], floatingValues(base), values);
    } else if (base.parent_from_child.matrix() != Eigen::Matrix4d::Identity()) {
      refuse(base, index ? "the joint is neither planar nor floating"
                         : "robot '" + robot.name() + "' has no such joint");
    }
  }
  return values;
}

}  // namespace swept
