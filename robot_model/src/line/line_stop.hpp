// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "line/line_model.hpp"
#include "swept/robot_model/tool_line.hpp"

namespace swept::detail {

/// Why inverse kinematics does not bring the tool to a pose just beyond the last way point.
/// `nearest`: the configuration that it found instead.
ToolLineStop whyNotSolved(const LineModel& model, const Eigen::Isometry3d& wanted,
                          std::span<const double> nearest, bool anyOrientation);

/// Why a chord just beyond a way point is not straight.
ToolLineStop whyNotStraight(const LineModel& model, std::span<const double> wayPoint,
                            bool anyOrientation);

/// The largest change of a value (rad or m), the shorter way for cyclic ones.
double largestChange(const KinematicModel& model, std::span<const double> from,
                     std::span<const double> to);

}  // namespace swept::detail
