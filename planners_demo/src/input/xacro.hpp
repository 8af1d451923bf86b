// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "command_line/arguments.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// The URDF that the program `xacro` (of ROS, looked for on the path) makes of `args.robot` with
/// `args.xacroArguments`. Throws UsageError where it cannot be run or fails.
std::string expandedUrdf(const Arguments& args);

/// The robot of that URDF. Lines in messages are those of `urdf`. Throws as Robot::load.
std::shared_ptr<const Robot> loadExpanded(const Arguments& args, const std::string& urdf,
                                          const std::filesystem::path& srdf,
                                          const LoadOptions& options);

}  // namespace swept
