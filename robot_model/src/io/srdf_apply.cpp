// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "io/numbers.hpp"
#include "io/srdf.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept::detail {

namespace {

void markPassive(const SrdfDocument& srdf, const InputSource& source, RobotParts& robot) {
  robot.passive.assign(robot.joints.size(), false);
  for (const auto& [name, line] : srdf.passive) {
    const int joint = indexOf(robot.joints, name);
    if (joint >= 0) {
      robot.passive[joint] = true;
    } else {
      source.warn(line, "<passive_joint>: joint '" + name + "' does not exist");
    }
  }
}

int variableCount(const RobotParts& robot, int joint) {
  return static_cast<int>(std::count_if(robot.variables.begin(), robot.variables.end(),
                                        [joint](const Variable& v) { return v.joint == joint; }));
}

/// A floating joint's last four values: must be a rotation, and become a unit quaternion.
void normaliseRotation(SrdfDocument::JointValue& value, const std::string& owner,
                       const InputSource& source) {
  const Eigen::Map<Eigen::Vector4d> given(value.values.data() + 3);
  const auto unit = unitQuaternion(given);
  if (!unit) {
    source.fail(value.line, owner + ": the quaternion (x, y, z, w) of joint '" + value.joint +
                                "' must have length 1");
  }
  std::copy(unit->coeffs().begin(), unit->coeffs().end(), value.values.begin() + 3);
}

void addValue(SrdfDocument::JointValue value, const InputSource& source, const RobotParts& robot,
              NamedState& state) {
  const std::string owner = "state '" + state.name + "'";
  const int index = indexOf(robot.joints, value.joint);
  if (index < 0) source.fail(value.line, owner + ": joint '" + value.joint + "' does not exist");
  const Joint& joint = robot.joints[index];
  if (joint.firstVariable < 0) return;  // fixed or following: nothing to set
  const int count = variableCount(robot, index);
  if (static_cast<int>(value.values.size()) != count) {
    source.fail(value.line, owner + ": joint '" + value.joint + "' has " + std::to_string(count) +
                                (count == 1 ? " value, " : " values, ") +
                                std::to_string(value.values.size()) + " given");
  }
  if (joint.type == JointType::Floating) normaliseRotation(value, owner, source);
  for (int i = 0; i < count; ++i) {
    const int v = joint.firstVariable + i;
    const Variable& variable = robot.variables[v];
    double number = value.values[i];
    if (const std::optional<double> limit = limitNear(variable, number)) {
      const TakenToLimit taken{variable.name, number, *limit, unitOf(joint, i)};
      source.warn(value.line, owner + ": " + limitRemark(taken));
      number = *limit;
    } else if (!variable.cyclic && !isWithin(number, variable.lower, variable.upper)) {
      source.warn(value.line, owner + ": " + variable.name + " = " + formatNumber(number) +
                                  " is outside its limits [" + formatNumber(variable.lower) + ", " +
                                  formatNumber(variable.upper) + "]");
    }
    for (const auto& [known, ignored] : state.values) {
      if (known == v) source.fail(value.line, owner + " sets joint '" + value.joint + "' twice");
    }
    state.values.emplace_back(v, number);
  }
}

void addStates(const SrdfDocument& srdf, const InputSource& source, RobotParts& robot) {
  for (const SrdfDocument::State& given : srdf.states) {
    if (indexOf(robot.groups, given.group) < 0) {
      source.fail(given.line,
                  "state '" + given.name + "': group '" + given.group + "' does not exist");
    }
    for (const NamedState& known : robot.namedStates) {
      if (known.name != given.name || known.group != given.group) continue;
      source.fail(given.line,
                  "group '" + given.group + "' has a second state '" + given.name + "'");
    }
    NamedState state{given.name, given.group, {}};
    for (const auto& value : given.values) addValue(value, source, robot, state);
    robot.namedStates.push_back(std::move(state));
  }
}

/// The two links, smaller index first; equal when the entry means no pair.
std::pair<int, int> lookUp(const SrdfDocument::Pair& pair, const InputSource& source,
                           const RobotParts& robot) {
  const std::string element = pair.enable ? "<enable_collisions>" : "<disable_collisions>";
  for (const std::string& name : {pair.link1, pair.link2}) {
    if (indexOf(robot.links, name) >= 0) continue;
    source.warn(pair.line, element + ": link '" + name + "' does not exist");
    return {0, 0};
  }
  const int a = indexOf(robot.links, pair.link1);
  const int b = indexOf(robot.links, pair.link2);
  if (a == b) source.warn(pair.line, element + " names link '" + pair.link1 + "' twice");
  return std::minmax(a, b);
}

void addDisabledPairs(const SrdfDocument& srdf, const InputSource& source, RobotParts& robot) {
  // An enabled pair wins wherever it stands: checking more is never unsound.
  std::set<std::pair<int, int>> taken;
  for (const auto& pair : srdf.pairs) {
    if (pair.enable) taken.insert(lookUp(pair, source, robot));
  }
  for (const auto& pair : srdf.pairs) {
    if (pair.enable) continue;
    const auto [a, b] = lookUp(pair, source, robot);
    if (a != b && taken.insert({a, b}).second) robot.disabledPairs.push_back({a, b, pair.reason});
  }
}

}  // namespace

void applySrdf(const SrdfDocument& srdf, const InputSource& source, RobotParts& robot) {
  if (!srdf.robot.name.empty() && srdf.robot.name != robot.name) {
    source.warn(srdf.robot.line, "the SRDF is for robot '" + srdf.robot.name + "', the URDF is '" +
                                     robot.name + "'");
  }
  markPassive(srdf, source, robot);
  addGroups(srdf, source, robot);
  addStates(srdf, source, robot);
  addDisabledPairs(srdf, source, robot);
}

}  // namespace swept::detail
