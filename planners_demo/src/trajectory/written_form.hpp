// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "swept/robot_model/joint_trajectory.hpp"

namespace swept {

/// The trajectory as a file holds it, so that what is proven is what a reader of the file gets. If
/// the robot starts elsewhere, that is its first point, at rest. In a YAML file, times are whole
/// nanoseconds; where two points would have the same, times stay as they are.
JointTrajectory writtenForm(JointTrajectory trajectory,
                            const std::optional<std::vector<double>>& start,
                            const std::filesystem::path& file);

}  // namespace swept
