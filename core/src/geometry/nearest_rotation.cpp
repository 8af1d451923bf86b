// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/nearest_rotation.hpp"

#include <limits>

namespace swept::detail {

using Eigen::Isometry3d;
using Eigen::Matrix3d;

// Newton's iteration R (3 - R^T R) / 2 keeps the orthogonal factor and takes E = R^T R - 1 to about
// -3/4 E^2: from 1e-3 to rounding in three steps.
std::optional<Isometry3d> nearestRigidPose(const Isometry3d& pose) {
  constexpr int kMostSteps = 4;
  Isometry3d rigid = pose;
  Matrix3d rotation = pose.linear();
  const Matrix3d off = rotation.transpose() * rotation - Matrix3d::Identity();
  if (!(off.array().abs() <= kNearRotation).all()) return std::nullopt;
  for (int step = 0; step < kMostSteps; ++step) {
    if (isRigidPose(rigid)) return rigid;
    rotation =
        0.5 * rotation * (3.0 * Matrix3d::Identity() - rotation.transpose() * rotation).eval();
    rigid.linear() = rotation;
  }
  return isRigidPose(rigid) ? std::optional(rigid) : std::nullopt;
}

Isometry3d rigidPose(const Isometry3d& pose) {
  if (isRigidPose(pose)) return pose;
  const std::optional<Isometry3d> rigid = nearestRigidPose(pose);
  if (rigid) return *rigid;
  Isometry3d none;
  none.matrix().setConstant(std::numeric_limits<double>::quiet_NaN());
  return none;
}

}  // namespace swept::detail
