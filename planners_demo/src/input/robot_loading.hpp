// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "command_line/arguments.hpp"
#include "input/xacro.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// What SWEPT_CACHE names; empty: nothing, so that no cover is kept.
std::filesystem::path cacheFolder();

/// The robot of `urdf`, which the command line names, with this SRDF (empty: none). Meanwhile a
/// line on the terminal says how many of its meshes are ready; remarks come when that is gone.
/// Throws as Robot::load.
std::shared_ptr<const Robot> loadRobot(const Arguments& args, const ExpandedText& urdf,
                                       const std::filesystem::path& srdf,
                                       const LoadOptions& options);

}  // namespace swept
