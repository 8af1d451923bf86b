// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "swept/robot_model/input.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// Limits of a group's joints, one for each value of its configuration; infinity: none. Of a planar
/// or floating joint, each value has its own; the components of an orientation have none.
struct RateLimits {
  std::vector<double> velocity;      ///< rad/s or m/s
  std::vector<double> acceleration;  ///< rad/s^2 or m/s^2
  std::vector<double> jerk;          ///< rad/s^3 or m/s^3

  /// The velocities of the URDF's `<limit velocity>`; nothing else has a limit.
  static RateLimits of(const Robot& robot, const Group& group);
  /// These, and what a file of MoveIt (`joint_limits.yaml`) says: it replaces the URDF's
  /// velocities, and adds accelerations and jerks. `default_velocity_scaling_factor` and
  /// `default_acceleration_scaling_factor` are applied. Throws InputError with file, line, value
  /// and what is allowed.
  static RateLimits read(const std::filesystem::path& file, const Robot& robot, const Group& group,
                         const LoadOptions& options = {});
};

}  // namespace swept
