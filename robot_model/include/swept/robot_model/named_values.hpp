// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/robot.hpp"

/// Configurations by the names of joints, in any order.
namespace swept {

/// rad or m, by Variable::name: the joint's name or, if it has several values, `joint/theta` and so
/// on.
using NamedValues = std::map<std::string, double, std::less<>>;

///@{
/// The group's configuration with these values, in its order. Variables that are not named have
/// their value in `others`, a configuration of the group (such as from namedConfiguration()).
/// Without `others`, every variable must be named. Limits are not checked: see takeToLimits().
///
/// Throws std::invalid_argument for a name that is none of the group's variables. The message says
/// why: the robot lacks it (with a suggestion), or the joint is not in the group, does not move,
/// mimics another one, or has several values. Also throws for missing values, with their names, and
/// for `others` of another size.
std::vector<double> configurationOf(const Robot& robot, const Group& group,
                                    const NamedValues& values);
std::vector<double> configurationOf(const Robot& robot, const Group& group,
                                    const NamedValues& values, ConfigurationView others);
///@}

/// The inverse: values by name. Throws std::invalid_argument unless there is a value for each of
/// the group's variables.
NamedValues namedValues(const Robot& robot, const Group& group, ConfigurationView q);

/// Values of all of the robot's variables, for CheckerOptions::reference. Those that are not named
/// are as in Robot::defaultState(). Throws as configurationOf does.
Eigen::VectorXd wholeStateOf(const Robot& robot, const NamedValues& values);

}  // namespace swept
