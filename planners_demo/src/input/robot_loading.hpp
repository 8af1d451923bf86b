// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "command_line/arguments.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// What SWEPT_CACHE names; empty: nothing, so that no cover is kept.
std::filesystem::path cacheFolder();

/// The robot of the command line, with this SRDF (empty: none); with --xacro that of `expanded`,
/// which expandedUrdf() gave. Meanwhile a line on the terminal says how many of its meshes are
/// ready; remarks come when that is gone. Throws as Robot::load and loadExpanded().
std::shared_ptr<const Robot> loadRobot(const Arguments& args, const std::string& expanded,
                                       const std::filesystem::path& srdf,
                                       const LoadOptions& options);

}  // namespace swept
