// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "command_line/arguments.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// The robot that the program `xacro` (of ROS, looked for on the path) makes of `args.robot` with
/// `args.xacroArguments`. Lines in messages are those of what it wrote. Throws UsageError where it
/// cannot be run or fails, and as Robot::load.
std::shared_ptr<const Robot> loadExpanded(const Arguments& args, const std::filesystem::path& srdf,
                                          const LoadOptions& options);

}  // namespace swept
