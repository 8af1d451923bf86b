// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_line/arguments.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/work_cell.hpp"

namespace swept {

/// Whether the robot that the command line names is a file of several: it ends in .yaml or .yml.
bool isWorkCell(const Arguments& args);

/// The robots of that file as one. Throws InputError as compose() does, and UsageError for --srdf
/// and --xacro, which are about the URDF of one robot.
ComposedRobot composedCell(const Arguments& args, const LoadOptions& options);

/// Values of all variables: `before`, or the default state, with those of --stand. Without it
/// `before`. Throws UsageError for an unknown group or state, and for values with --degrees.
std::optional<Eigen::VectorXd> withStanding(const Arguments& args, const Robot& robot,
                                            std::optional<Eigen::VectorXd> before,
                                            const LoadOptions& options);

/// Those of --stand that do nothing, since `moving` moves all that their group does.
std::vector<std::string> idleStanding(const Arguments& args, const Robot& robot,
                                      const Group& moving);

}  // namespace swept
