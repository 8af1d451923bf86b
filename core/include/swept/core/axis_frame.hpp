// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "swept/core/floating_point_environment.hpp"

namespace swept {

/// The rotation by the least angle that takes z to the direction of `axis`; for -z the half turn
/// about x. `axis` is finite and not zero; its length does not matter. The result is within a few
/// roundings of a rotation for every axis. (The quaternion between the two vectors is not, for axes
/// near -z.)
inline Eigen::Matrix3d axisFrame(const Eigen::Vector3d& axis) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return axisFrame(axis); });
  }
  // Scaled first: the squares of very small or large components would not be numbers.
  const Eigen::Vector3d z = (axis / axis.cwiseAbs().maxCoeff()).normalized();
  const double sine = std::hypot(z.x(), z.y());
  constexpr double kLeast = 1e-290;  // below, quotients have few digits
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  if (!(sine > kLeast)) {
    frame.diagonal() << 1.0, std::copysign(1.0, z.z()), std::copysign(1.0, z.z());
    return frame;
  }
  const Eigen::Vector2d across = z.head<2>() / sine;
  frame.topLeftCorner<2, 2>() -= (1.0 - z.z()) * across * across.transpose();
  frame.row(2).head<2>() = -z.head<2>().transpose();
  frame.col(2) = z;
  return frame;
}

}  // namespace swept
