// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "swept/robot_model/robot.hpp"

namespace swept {

namespace detail {

/// A robot while it is being put together; the fields are those of Robot.
struct RobotParts {
  std::string name;
  std::string modelFrame;
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Variable> variables;
  std::vector<Group> groups;
  std::vector<NamedState> namedStates;
  std::vector<DisabledPair> disabledPairs;
  std::vector<EnabledPair> enabledPairs;
  std::vector<LeftOut> leftOut;
};

/// Index of the entry with that name, or -1.
template <typename Entry>
int indexOf(const std::vector<Entry>& entries, std::string_view name) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace detail

/// The one way to make a Robot.
class RobotBuilder {
 public:
  static std::shared_ptr<const Robot> build(detail::RobotParts parts);
};

}  // namespace swept
