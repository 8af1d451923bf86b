// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "command_line/arguments.hpp"
#include "swept/robot_model/collision_rules.hpp"

namespace swept {

/// What --allow, --pad and --scale say. Throws UsageError.
CollisionRules rulesOf(const Arguments& args);

/// The two names of `A,B`. Throws UsageError.
std::pair<std::string, std::string> namesOfPair(const std::string& option, const std::string& text);

}  // namespace swept
