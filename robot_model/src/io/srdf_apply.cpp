// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>

#include "io/srdf.hpp"
#include "io/warning_kinds.hpp"
#include "robot/joint_types.hpp"
#include "swept/robot_model/limits.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

void markPassive(const SrdfDocument& srdf, RobotParts& robot, WarningKinds& warnings) {
  for (const auto& [name, line] : srdf.passive) {
    const int joint = indexOf(robot.joints, name);
    if (joint >= 0)
      robot.joints[joint].passive = true;
    else
      warnings.add(line, "<passive_joint>: joint '" + name + "' does not exist",
                   "<passive_joint>: # joints do not exist");
  }
}

int variableCount(const RobotParts& robot, int joint) {
  return static_cast<int>(std::count_if(robot.variables.begin(), robot.variables.end(),
                                        [joint](const Variable& v) { return v.joint == joint; }));
}

/// The four values at `place` must be a rotation, and become a unit quaternion.
void normaliseRotation(SrdfDocument::JointValue& value, int place, const std::string& owner,
                       const InputSource& source) {
  const Eigen::Map<Eigen::Vector4d> given(value.values.data() + place);
  const auto unit = unitQuaternion(given);
  if (!unit) {
    source.fail(value.line, owner + ": the quaternion (x, y, z, w) of joint '" + value.joint +
                                "' must have length 1");
  }
  std::copy(unit->coeffs().begin(), unit->coeffs().end(), value.values.begin() + place);
}

void addValue(SrdfDocument::JointValue value, const InputSource& source, const RobotParts& robot,
              NamedState& state, WarningKinds& warnings) {
  const std::string owner = "state '" + state.name + "'";
  const int index = indexOf(robot.joints, value.joint);
  if (index < 0) {
    // Pinocchio's states begin with a `root_joint`. The group's own joints are there, or it is not.
    const std::string what = "joint '" + value.joint + "'";
    warnings.add(value.line, owner + ": " + what + " does not exist; its value is left out",
                 "<group_state>: # states have a value for " + what +
                     ", which does not exist; the values are left out");
    return;
  }
  const Joint& joint = robot.joints[index];
  if (joint.firstVariable < 0) return;  // fixed or following: nothing to set
  const int count = variableCount(robot, index);
  if (static_cast<int>(value.values.size()) != count) {
    source.fail(value.line, owner + ": joint '" + value.joint + "' has " + std::to_string(count) +
                                (count == 1 ? " value, " : " values, ") +
                                std::to_string(value.values.size()) + " given");
  }
  if (const std::optional<int> place = quaternionPlace(joint.type))
    normaliseRotation(value, *place, owner, source);
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

void addStates(const SrdfDocument& srdf, const InputSource& source, RobotParts& robot,
               WarningKinds& warnings) {
  for (const SrdfDocument::State& given : srdf.states) {
    if (indexOf(robot.groups, given.group) < 0) {
      const bool known = indexOf(srdf.groups, given.group) >= 0;
      const std::string what =
          "group '" + given.group + "' " + (known ? "is left out" : "does not exist");
      warnings.add(given.line, "state '" + given.name + "' is left out: " + what,
                   "<group_state>: # states are left out: " + what);
      robot.leftOut.push_back({given.group, given.name,
                               source.name() + ":" + std::to_string(given.line) + ": " + what});
      continue;
    }
    for (const NamedState& known : robot.namedStates) {
      if (known.name != given.name || known.group != given.group) continue;
      source.fail(given.line,
                  "group '" + given.group + "' has a second state '" + given.name + "'");
    }
    NamedState state{given.name, given.group, {}};
    for (const auto& value : given.values) addValue(value, source, robot, state, warnings);
    robot.namedStates.push_back(std::move(state));
  }
}

}  // namespace

void applySrdf(const SrdfDocument& srdf, const InputSource& source, RobotParts& robot) {
  if (!srdf.robot.name.empty() && srdf.robot.name != robot.name) {
    source.warn(srdf.robot.line, "the SRDF is for robot '" + srdf.robot.name + "', the URDF is '" +
                                     robot.name + "'");
  }
  WarningKinds warnings(source);
  markPassive(srdf, robot, warnings);
  warnings.flush();
  addGroups(srdf, source, robot);
  addStates(srdf, source, robot, warnings);
  warnings.flush();
  addPairs(srdf, source, robot);
}

}  // namespace swept::detail
