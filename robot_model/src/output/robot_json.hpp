// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "output/text_output.hpp"
#include "swept/robot_model/robot.hpp"

/// Parts of a robot as `info --json` and proofs have them.
namespace swept {

/// As a URDF has it.
std::string_view toString(JointType type);

Json variableJson(const Variable& variable);

}  // namespace swept
