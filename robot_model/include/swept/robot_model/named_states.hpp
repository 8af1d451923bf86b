// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// Each group's state of this name is Robot::defaultState(), unless the SRDF gives it one.
inline constexpr std::string_view kDefaultState = "default";

/// The group's values, in its order, in a state that the SRDF names: a configuration as Checker and
/// StateConversion::toState take it: within the limits, unless loading has warned of it. So is
/// kDefaultState. Throws
/// std::invalid_argument when the group has no state of that name (the message lists those it has,
/// or says why the SRDF's was left out) or the state has no value for one of the group's variables.
std::vector<double> namedConfiguration(const Robot& robot, const Group& group,
                                       std::string_view name);

/// The other way: a state as an SRDF has it, of the group's values in its order. Throws
/// std::invalid_argument unless there is one for each of its variables.
NamedState makeNamedState(const Group& group, std::string name, ConfigurationView q);

}  // namespace swept
