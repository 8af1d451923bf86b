// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace swept::detail {

/// A finite rotation and translation. A matrix that comes from a file or from products is as far
/// from orthonormal as their rounding.
inline bool isRigid(const Eigen::Isometry3d& pose) {
  constexpr double kOrthonormal = 1e-9;
  const Eigen::Matrix3d r = pose.linear();
  const Eigen::Matrix3d defect = r * r.transpose() - Eigen::Matrix3d::Identity();
  return pose.translation().allFinite() && defect.cwiseAbs().maxCoeff() <= kOrthonormal &&
         r.determinant() > 0.0 && pose.matrix().row(3) == Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0);
}

}  // namespace swept::detail
