// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/rotation_vector.hpp"

#include <cmath>

namespace swept::detail {

Eigen::Vector3d rotationVectorOf(const Eigen::Matrix3d& rotation) {
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (!(sine > 1e-150)) return 2.0 * q.vec();
  return (2.0 * std::atan2(sine, q.w()) / sine) * q.vec();
}

Eigen::Vector3d rateOfRotationVector(const Eigen::Vector3d& v, const Eigen::Vector3d& w) {
  constexpr double kSmall = 1e-3;  // rad; the series is then off by less than 1e-17
  const double f = v.norm();
  const double c =
      f < kSmall ? 1.0 / 12.0 + f * f / 720.0 : (1.0 - 0.5 * f / std::tan(0.5 * f)) / (f * f);
  const Eigen::Vector3d turned = v.cross(w);
  return w - 0.5 * turned + c * v.cross(turned);
}

}  // namespace swept::detail
