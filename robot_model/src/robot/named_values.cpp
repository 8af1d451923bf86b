// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/named_values.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>

#include "swept/robot_model/did_you_mean.hpp"

namespace swept {

namespace {

std::string quoted(const std::string& name) {
  return "`" + name + "`";
}

/// `a`, `b`, of the robot's variables.
std::string namesOf(const Robot& robot, const std::vector<int>& variables) {
  std::string text;
  for (const int index : variables)
    text += (text.empty() ? "" : ", ") + quoted(robot.variables()[index].name);
  return text;
}

/// Why a joint cannot be given a value by its name.
std::string whyNoVariable(const Robot& robot, int index) {
  const Joint& joint = robot.joints()[index];
  if (joint.mimic)
    return "joint " + quoted(joint.name) + " has no value of its own: it follows " +
           quoted(robot.joints()[joint.mimic->master].name);
  if (joint.firstVariable < 0) return "joint " + quoted(joint.name) + " has no value: it is fixed";
  std::vector<int> own;
  for (int i = 0; i < static_cast<int>(robot.variables().size()); ++i)
    if (robot.variables()[i].joint == index) own.push_back(i);
  return "joint " + quoted(joint.name) + " has " + std::to_string(own.size()) +
         " values, each by its name: " + namesOf(robot, own);
}

/// Index of a variable. Throws for an unknown name.
int variableOf(const Robot& robot, const std::string& name) {
  if (const auto variable = robot.findVariable(name)) return *variable;
  if (const auto joint = robot.findJoint(name))
    throw std::invalid_argument(whyNoVariable(robot, *joint));
  std::vector<std::string> known;
  for (const Variable& variable : robot.variables()) known.push_back(variable.name);
  throw std::invalid_argument("robot `" + robot.name() + "` has no joint " + quoted(name) +
                              didYouMean(name, known));
}

/// Index of a variable in the group's configuration. Throws if it has none.
std::size_t placeOf(const Robot& robot, const Group& group, const std::string& name) {
  const auto found = std::ranges::find(group.variables, variableOf(robot, name));
  if (found != group.variables.end())
    return static_cast<std::size_t>(found - group.variables.begin());
  throw std::invalid_argument("joint " + quoted(name) + " is not in group " + quoted(group.name) +
                              ", which has " + namesOf(robot, group.variables));
}

void requireSize(const Group& group, ConfigurationView q) {
  if (q.size() == group.variables.size()) return;
  throw std::invalid_argument("a configuration of group " + quoted(group.name) + " has " +
                              std::to_string(group.variables.size()) + " values, not " +
                              std::to_string(q.size()));
}

}  // namespace

std::vector<double> configurationOf(const Robot& robot, const Group& group,
                                    const NamedValues& values) {
  std::vector<std::optional<double>> given(group.variables.size());
  for (const auto& [name, value] : values) given[placeOf(robot, group, name)] = value;
  std::vector<double> q;
  std::vector<int> missing;
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i])
      q.push_back(*given[i]);
    else
      missing.push_back(group.variables[i]);
  }
  if (missing.empty()) return q;
  throw std::invalid_argument("group " + quoted(group.name) + ": no value for " +
                              namesOf(robot, missing));
}

std::vector<double> configurationOf(const Robot& robot, const Group& group,
                                    const NamedValues& values, ConfigurationView others) {
  requireSize(group, others);
  std::vector<double> q(others.begin(), others.end());
  for (const auto& [name, value] : values) q[placeOf(robot, group, name)] = value;
  return q;
}

NamedValues namedValues(const Robot& robot, const Group& group, ConfigurationView q) {
  requireSize(group, q);
  NamedValues values;
  for (std::size_t i = 0; i < q.size(); ++i)
    values.emplace(robot.variables()[group.variables[i]].name, q[i]);
  return values;
}

Eigen::VectorXd wholeStateOf(const Robot& robot, const NamedValues& values) {
  Eigen::VectorXd state = robot.defaultState();
  for (const auto& [name, value] : values) state[variableOf(robot, name)] = value;
  return state;
}

}  // namespace swept
