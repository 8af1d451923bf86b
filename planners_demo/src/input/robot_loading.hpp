// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "command_line/arguments.hpp"
#include "input/xacro.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/work_cell.hpp"

namespace swept {

/// The folder that SWEPT_CACHE names; empty: none, so that no cover is kept.
std::filesystem::path cacheFolder();

/// Loads the robot of `urdf`, which the command line names, with this SRDF (empty: none). Meanwhile
/// a line on the terminal counts the meshes that are ready. Warnings follow when that line is gone.
/// Throws as Robot::load.
std::shared_ptr<const Robot> loadRobot(const Arguments& args, const ExpandedText& urdf,
                                       const std::filesystem::path& srdf,
                                       const LoadOptions& options);
/// The same, of a work cell. Throws as loadComposed().
std::shared_ptr<const Robot> loadRobot(const Arguments& args, const ComposedRobot& cell,
                                       const LoadOptions& options);

}  // namespace swept
