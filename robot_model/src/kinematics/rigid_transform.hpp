// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace swept::detail {

/// Whether it is a finite rotation and translation. A matrix from a file or from products is as far
/// from orthonormal as their rounding.
inline bool isRigid(const Eigen::Isometry3d& pose) {
  constexpr double kOrthonormal = 1e-9;
  const Eigen::Matrix3d r = pose.linear();
  const Eigen::Matrix3d defect = r * r.transpose() - Eigen::Matrix3d::Identity();
  return pose.translation().allFinite() && defect.cwiseAbs().maxCoeff() <= kOrthonormal &&
         r.determinant() > 0.0 && pose.matrix().row(3) == Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0);
}

/// A rigid transform (see isRigid) with a rotation instead of a matrix up to 1e-9 from one: the
/// transpose serves as the inverse of a pose, and 1e-9 of coordinates is more than
/// kRoundingPerJoint allows for. A matrix that is as accurate as a product of rotations is not
/// changed.
inline Eigen::Isometry3d orthonormalized(const Eigen::Isometry3d& rigid) {
  constexpr double kAsGoodAsProducts = 1e-14;
  const Eigen::Matrix3d r = rigid.linear();
  const Eigen::Matrix3d defect = r * r.transpose() - Eigen::Matrix3d::Identity();
  if (defect.cwiseAbs().maxCoeff() <= kAsGoodAsProducts) return rigid;
  Eigen::Isometry3d rotated = rigid;
  rotated.linear() = Eigen::Quaterniond(r).normalized().toRotationMatrix();
  return rotated;
}

}  // namespace swept::detail
