// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "swept/robot_model/robot.hpp"

namespace swept {

/// The group's values, in its order, in a state that the SRDF names: a configuration as Checker and
/// StateConversion::toState take it: within the limits, unless loading has warned of it. Throws
/// std::invalid_argument when the group has no state of that name (the message lists those it has)
/// or the state has no value for one of the group's variables.
std::vector<double> namedConfiguration(const Robot& robot, const Group& group,
                                       std::string_view name);

/// The other way: a state as an SRDF has it, of the group's values in its order. Throws
/// std::invalid_argument unless there is one for each of its variables.
NamedState makeNamedState(const Group& group, std::string name, std::span<const double> q);

}  // namespace swept
