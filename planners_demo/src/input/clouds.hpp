// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "command_line/arguments.hpp"
#include "output/clouds_json.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/world.hpp"

namespace swept {

/// Adds the files of --cloud to the world, each as a body named after its file. `reference`: of the
/// joints outside the group when they were seen; empty: the default state. Throws InputError or
/// UsageError.
void addClouds(const Arguments& args, const Robot& robot,
               const std::optional<Eigen::VectorXd>& reference, const LoadOptions& options,
               World& world);

}  // namespace swept
