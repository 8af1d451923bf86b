// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/named_states.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "swept/core/floating_point_environment.hpp"

namespace swept {

std::vector<double> namedConfiguration(const Robot& robot, const Group& group,
                                       std::string_view name) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, name] { return namedConfiguration(robot, group, name); });
  }
  const NamedState* state = robot.findNamedState(name, group.name);
  if (state == nullptr && name == kDefaultState) {
    const Eigen::VectorXd whole = robot.defaultState();
    std::vector<double> q;
    for (const int variable : group.variables) q.push_back(whole[variable]);
    return q;
  }
  if (state == nullptr) {
    for (const LeftOut& out : robot.leftOut())
      if (out.group == group.name && out.state == name)
        throw std::invalid_argument("named state `" + out.state + "` of group `" + group.name +
                                    "` is left out: " + out.reason);
    std::string known;
    for (const NamedState& other : robot.namedStates())
      if (other.group == group.name) known += other.name + ", ";
    throw std::invalid_argument("group `" + group.name + "` has no named state `" +
                                std::string(name) + "`; it has " + known +
                                std::string(kDefaultState));
  }
  std::vector<double> q;
  for (const int variable : group.variables) {
    const auto found = std::ranges::find(state->values, variable, &std::pair<int, double>::first);
    if (found == state->values.end())
      throw std::invalid_argument("named state `" + state->name + "` of group `" + group.name +
                                  "` has no value for `" + robot.variables()[variable].name + "`");
    q.push_back(found->second);
  }
  return q;
}

NamedState makeNamedState(const Group& group, std::string name, ConfigurationView q) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, q] { return makeNamedState(group, std::move(name), q); });
  }
  if (q.size() != group.variables.size())
    throw std::invalid_argument("a configuration of the group has " +
                                std::to_string(group.variables.size()) + " values, not " +
                                std::to_string(q.size()));
  NamedState state{std::move(name), group.name, {}};
  for (std::size_t i = 0; i < q.size(); ++i) state.values.emplace_back(group.variables[i], q[i]);
  return state;
}

}  // namespace swept
