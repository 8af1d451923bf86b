// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "swept/robot_model/input.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// Limits of a group's joints, one for each value of its configuration; infinity: none. Each value
/// of a planar or floating joint has its own; the components of an orientation have none.
struct RateLimits {
  std::vector<double> velocity;      ///< rad/s or m/s
  std::vector<double> acceleration;  ///< rad/s^2 or m/s^2
  std::vector<double> jerk;          ///< rad/s^3 or m/s^3

  /// The velocities of the URDF (Variable::velocity); nothing else has a limit.
  static RateLimits of(const Robot& robot, const Group& group);
  /// These, changed as MoveIt's `joint_limits.yaml` says: it sets velocities, accelerations and
  /// jerks, or removes a velocity of the URDF. If the file limits a deceleration too, the lesser of
  /// it and the acceleration is the limit of both. Velocities and accelerations are multiplied by
  /// the file's `default_velocity_scaling_factor` and `default_acceleration_scaling_factor`.
  /// robot_model/FORMATS.md has all keys.
  ///
  /// The file may name joints of the robot that are not in the group. Its limits of positions are
  /// not used; LoadOptions::warn receives a remark for each that differs from the URDF's. Throws
  /// InputError with file, line, value and what is allowed.
  static RateLimits read(const std::filesystem::path& file, const Robot& robot, const Group& group,
                         const LoadOptions& options = {});
};

}  // namespace swept
