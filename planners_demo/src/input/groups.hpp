// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "command_line/arguments.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// Whether a group is asked for.
bool asksForGroup(const Arguments& args);

/// The group asked for by --group, --joints or --chain; else the only one with joints, or the only
/// one that has all named states that are given. Throws UsageError, listing the groups.
const Group& chooseGroup(const Robot& robot, const Arguments& args);
/// The group of this name; without a name, the only one with joints. Throws likewise.
const Group& chooseGroup(const Robot& robot, const std::string& name);

/// The robot with the group of --joints or --chain. Throws UsageError.
std::shared_ptr<const Robot> withAskedGroup(std::shared_ptr<const Robot> robot,
                                            const Arguments& args);

}  // namespace swept
