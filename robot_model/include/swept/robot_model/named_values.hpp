// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/robot.hpp"

/// Configurations by the names of joints, in whatever order a program or a message has them.
namespace swept {

/// rad or m, by Variable::name: the joint's or, where it has several, `joint/theta` and the like.
using NamedValues = std::map<std::string, double, std::less<>>;

///@{
/// The group's configuration with these values, in its order. What is not named has the value that
/// it has in `others`, a configuration of the group (namedConfiguration() has one by name);
/// without, each has to be named. Limits are not looked at: see takeToLimits().
///
/// Throws std::invalid_argument for a name that is none of the group's variables, and says why: the
/// robot has no such thing (and what is called nearly so), the joint is not in the group, does not
/// move, mimics another one, or has several values; where values are missing, with their names; and
/// for `others` of another size.
std::vector<double> configurationOf(const Robot& robot, const Group& group,
                                    const NamedValues& values);
std::vector<double> configurationOf(const Robot& robot, const Group& group,
                                    const NamedValues& values, ConfigurationView others);
///@}

/// The other way. Throws std::invalid_argument unless there is a value for each of the group's
/// variables.
NamedValues namedValues(const Robot& robot, const Group& group, ConfigurationView q);

/// All of the robot's values, those that are not named as in Robot::defaultState(): for
/// CheckerOptions::reference. Throws as configurationOf.
Eigen::VectorXd wholeStateOf(const Robot& robot, const NamedValues& values);

}  // namespace swept
