// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/message_columns.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "robot/joint_types.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace swept::detail {

namespace {

bool isPlanar(const BaseColumns& base) {
  return base.joint->type == JointType::Planar;
}

/// All of a joint's variables, from `first` on.
void requireTogether(const JointTrajectory& trajectory, const Robot& robot, const Joint& joint,
                     std::size_t first) {
  const auto count = static_cast<std::size_t>(valueCount(joint.type));
  for (std::size_t k = 0; k < count; ++k) {
    const std::string& name =
        robot.variables()[static_cast<std::size_t>(joint.firstVariable) + k].name;
    if (first + k >= trajectory.variables.size() || trajectory.variables[first + k] != name)
      throw std::invalid_argument("writeTrajectory: the variables of joint '" + joint.name +
                                  "' must follow each other in the robot's order; '" + name +
                                  "' is not there");
  }
}

}  // namespace

std::array<double, 7> BaseColumns::pose(const std::vector<double>& positions) const {
  const double* q = positions.data() + first;
  if (isPlanar(*this))
    return {q[0], q[1], 0.0, 0.0, 0.0, std::sin(0.5 * q[2]), std::cos(0.5 * q[2])};
  return {q[0], q[1], q[2], q[3], q[4], q[5], q[6]};
}

std::array<double, 6> BaseColumns::twist(const std::vector<double>& rates) const {
  const double* rate = rates.data() + first;
  return {rate[0], rate[1], 0.0, 0.0, 0.0, rate[2]};
}

JointColumns allJoints(std::size_t variables) {
  JointColumns columns{std::vector<std::size_t>(variables)};
  std::iota(columns.places.begin(), columns.places.end(), 0U);
  return columns;
}

MessageColumns messageColumns(const JointTrajectory& trajectory, const Robot& robot) {
  MessageColumns columns;
  for (std::size_t i = 0; i < trajectory.variables.size(); ++i) {
    const std::optional<int> variable = robot.findVariable(trajectory.variables[i]);
    if (!variable)
      throw std::invalid_argument("writeTrajectory: robot '" + robot.name() +
                                  "' has no variable '" + trajectory.variables[i] + "'");
    const Joint& joint = robot.joints()[robot.variables()[*variable].joint];
    if (valueCount(joint.type) == 1) {
      columns.joints.places.push_back(i);
      continue;
    }
    requireTogether(trajectory, robot, joint, i);
    columns.bases.push_back({&joint, i});
    i += static_cast<std::size_t>(valueCount(joint.type)) - 1;
  }
  return columns;
}

void requireMessageHolds(const JointTrajectory& trajectory, const MessageColumns& columns,
                         const std::string& where) {
  const bool moves = std::ranges::any_of(trajectory.points, [](const TrajectoryPoint& point) {
    return !point.velocities.empty() || !point.accelerations.empty();
  });
  for (const BaseColumns& base : columns.bases) {
    if (isPlanar(base) && base.joint->axis != Eigen::Vector3d::UnitZ())
      throw UsageError(where + ": the axis of planar joint '" + base.joint->name +
                       "' is not z, and a message has no other; use .json or .csv");
    if (!isPlanar(base) && moves)
      throw UsageError(where + ": '" + base.joint->name +
                       "' is a floating joint, of which a message has no velocities and "
                       "accelerations; use .json or .csv");
  }
}

std::vector<std::string> namesOf(const std::vector<BaseColumns>& bases) {
  std::vector<std::string> names;
  for (const BaseColumns& base : bases) names.push_back(base.joint->name);
  return names;
}

}  // namespace swept::detail
