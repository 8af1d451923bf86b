// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// Every group has a state of this name. It is Robot::defaultState(), unless the SRDF defines it.
inline constexpr std::string_view kDefaultState = "default";

/// The group's values, in its order, in a state that the SRDF names, or in kDefaultState. It is a
/// configuration for Checker and StateConversion::toState, and within the limits, unless loading
/// has warned of it. Throws std::invalid_argument if the group has no state of that name (the
/// message lists those it has, or says why the SRDF's was dropped), or if the state lacks a value
/// for one of the group's variables.
std::vector<double> namedConfiguration(const Robot& robot, const Group& group,
                                       std::string_view name);

/// The inverse: a named state for an SRDF, from the group's values in its order. Throws
/// std::invalid_argument unless there is one for each of its variables.
NamedState makeNamedState(const Group& group, std::string name, ConfigurationView q);

}  // namespace swept
