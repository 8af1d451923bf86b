// SPDX-License-Identifier: BSD-3-Clause
#include "io/judged_state.hpp"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "output/text_output.hpp"
#include "robot/joint_types.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

std::string normalizeOrientations(const Robot& robot, const Group& group, std::span<double> q) {
  constexpr double kRounding = 1e-15;  // four squares, three sums, a root and a quotient
  for (std::size_t i = 0; i < group.variables.size(); ++i) {
    const Joint& joint = robot.joints()[robot.variables()[group.variables[i]].joint];
    const std::optional<int> place = quaternionPlace(joint.type);
    if (!place || group.variables[i] != joint.firstVariable + *place) continue;
    Eigen::Map<Eigen::Vector4d> orientation(q.data() + i);
    const double norm = orientation.norm();
    if (!unitQuaternion(orientation))
      return "the quaternion of joint " + joint.name + " has norm " + shortNumber(norm) +
             ", allowed is 1";
    if (std::abs(norm - 1.0) > kRounding) orientation /= norm;
  }
  return {};
}

JudgedState judgeState(const Robot& robot, const Group& group, std::span<double> q) {
  JudgedState judged{.problem = normalizeOrientations(robot, group, q), .taken = {}};
  for (std::size_t i = 0; i < group.variables.size() && judged.problem.empty(); ++i) {
    const Variable& variable = robot.variables()[group.variables[i]];
    double& value = q[i];
    if (variable.cyclic && !(value >= variable.lower && value <= variable.upper))
      value = std::remainder(value, 2.0 * std::numbers::pi);
    if (!isWithin(value, variable.lower, variable.upper))
      judged.problem = outsideText(variable.name, value, variable.lower, variable.upper,
                                   unitOf(robot, variable));
  }
  if (judged.problem.empty()) judged.taken = takeToLimits(robot, group, q);
  return judged;
}

std::string whyElsewhere(const Robot& robot, const Joint& joint, double value,
                         const std::function<double(int variable)>& valueOf) {
  constexpr double kPlay = 1e-3;  // rad or m. A gear's play, a rounded multiplier
  double wanted = 0.0;
  std::string why = "does not move";
  if (joint.mimic) {
    const Joint& master = robot.joints()[static_cast<std::size_t>(joint.mimic->master)];
    wanted = joint.mimic->multiplier * valueOf(master.firstVariable) + joint.mimic->offset;
    why = "follows '" + master.name + "' to " + formatNumber(wanted);
  }
  double off = value - wanted;
  if (joint.type == JointType::Continuous) off = std::remainder(off, 2.0 * std::numbers::pi);
  return std::abs(off) <= kPlay ? std::string() : why;
}

}  // namespace swept::detail
