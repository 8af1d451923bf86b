// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/robot.hpp"

#include <algorithm>

#include "robot/joint_types.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

namespace {

template <typename Entry>
std::optional<int> find(const std::vector<Entry>& entries, std::string_view name) {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [name](const Entry& e) { return e.name == name; });
  if (found == entries.end()) return std::nullopt;
  return static_cast<int>(found - entries.begin());
}

}  // namespace

std::optional<int> Robot::findLink(std::string_view name) const {
  return find(links_, name);
}

std::optional<int> Robot::findJoint(std::string_view name) const {
  return find(joints_, name);
}

std::optional<int> Robot::findVariable(std::string_view name) const {
  return find(variables_, name);
}

std::vector<std::string> Robot::linksWithoutGeometry() const {
  std::vector<std::string> names;
  for (const Link& link : links_)
    if (link.hasVisual && link.collision.empty()) names.push_back(link.name);
  return names;
}

const Group* Robot::findGroup(std::string_view name) const {
  const auto index = find(groups_, name);
  return index ? &groups_[*index] : nullptr;
}

const NamedState* Robot::findNamedState(std::string_view name, std::string_view group) const {
  const auto found = std::find_if(
      namedStates_.begin(), namedStates_.end(),
      [&](const NamedState& state) { return state.name == name && state.group == group; });
  return found == namedStates_.end() ? nullptr : &*found;
}

Eigen::VectorXd Robot::defaultState() const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return defaultState(); });
  }
  Eigen::VectorXd q(static_cast<Eigen::Index>(variables_.size()));
  for (std::size_t v = 0; v < variables_.size(); ++v) {
    const double lower = variables_[v].lower;
    const double upper = variables_[v].upper;
    const bool zeroAllowed = lower <= 0.0 && upper >= 0.0;
    // Halved first: the sum of two large limits would overflow.
    q[static_cast<Eigen::Index>(v)] = zeroAllowed ? 0.0 : 0.5 * lower + 0.5 * upper;
  }
  for (const Joint& joint : joints_) {
    if (const std::optional<int> place = detail::quaternionPlace(joint.type))
      q[joint.firstVariable + *place + 3] = 1.0;
  }
  return q;
}

}  // namespace swept
