// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>

namespace swept::detail {

/// No unit. How far the entries of R^T R, with R a pose's linear part, may be from those of the
/// identity if the pose is to count as rigid, with the rotation nearest to R. Larger: scaling or
/// shear would count as a rotation. Smaller: poses with few digits get no answer.
inline constexpr double kNearRotation = 1e-3;

/// Whether queries may use the pose as it is: it is finite, and R is nearly a rotation.
///
/// Lemma: let E = R^T R - 1, of Frobenius norm e. By the polar decomposition R = Q (1 + E)^(1/2)
/// there is a rotation (or reflection) Q with |R - Q| and |R^T - Q^T| at most e / 2 (1 + e), and
/// R^T is at most e (1 + e) from the inverse of R. For e = 8e-15 that is half of kSupportRounding;
/// the queries' own operations use the other half.
inline bool isRigidPose(const Eigen::Isometry3d& pose) {
  constexpr double kMost = 8e-15;
  const Eigen::Matrix<double, 4, 4>& m = pose.matrix();
  const auto product = [&](int i, int j) {
    return m(0, i) * m(0, j) + m(1, i) * m(1, j) + m(2, i) * m(2, j);
  };
  const double x = product(0, 0) - 1.0;
  const double y = product(1, 1) - 1.0;
  const double z = product(2, 2) - 1.0;
  const double xy = product(0, 1);
  const double yz = product(1, 2);
  const double zx = product(2, 0);
  const double squared = (x * x + y * y + z * z) + 2.0 * (xy * xy + yz * yz + zx * zx);
  // Zero unless a coordinate is infinite or NaN.
  const double finite = 0.0 * m(0, 3) + 0.0 * m(1, 3) + 0.0 * m(2, 3);
  return squared + finite <= kMost * kMost;
}

/// The rigid pose that stands for a pose that is not rigid enough: the same translation, and the
/// rotation nearest to its linear part (polar decomposition). Every query with poses uses it, so
/// that all agree. No value if the pose is not finite, or farther from rigid than kNearRotation.
std::optional<Eigen::Isometry3d> nearestRigidPose(const Eigen::Isometry3d& pose);

/// The pose itself if it is rigid enough, else the nearest rigid one; NaN if there is none.
Eigen::Isometry3d rigidPose(const Eigen::Isometry3d& pose);

}  // namespace swept::detail
