// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "io/input_source.hpp"
#include "io/json_place.hpp"
#include "io/trajectory_rows.hpp"
#include "swept/robot_model/robot.hpp"

/// The formats of trajectories, which readTrajectories() chooses from. They add a file's
/// trajectories to `rows`, and throw InputError.
namespace swept::detail {

void readCsvTrajectory(const std::string& text, const InputSource& source, TrajectoryRows& rows);
void readJsonTrajectory(const std::string& text, const InputSource& source, TrajectoryRows& rows);
/// The object `trajectory` of a JSON file.
void readJsonTrajectory(const JsonPlace& trajectory, TrajectoryRows& rows);
void readYamlTrajectories(const std::string& text, const InputSource& source, const Robot& robot,
                          TrajectoryRows& rows);

}  // namespace swept::detail
