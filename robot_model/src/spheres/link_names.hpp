// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/json_value.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// What messages say about a link that the robot lacks; empty: it has it.
std::string unknownLink(const Robot& robot, const std::string& name);

/// The URDF that a file for VAMP's generator names, from where that file is; none: it is no such
/// file.
std::optional<std::filesystem::path> urdfOfConfiguration(const JsonValue& root);

}  // namespace swept::detail
