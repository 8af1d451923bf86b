// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "../../core/split_mix.hpp"

namespace sweeps {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Each sweep has its own, so that any one can be made alone.
class Random : public swept::test::SplitMix {
 public:
  Random(std::uint64_t seed, std::uint64_t index) : SplitMix(seed * 0x2545f4914f6cdd1du) {
    state_ = next() ^ (index * 0x9e3779b97f4a7c15u);
    next();
  }

  Vector3d across(const Vector3d& axis) {
    const Vector3d u = axis.unitOrthogonal();
    const double angle = uniform(0.0, 2.0 * std::numbers::pi);
    return (std::cos(angle) * u + std::sin(angle) * axis.cross(u)).normalized();
  }
  /// One in four turns axes onto axes.
  Matrix3d rotation() {
    const Vector3d axis = direction();
    const double angle = uniform(0.0, 2.0 * std::numbers::pi);
    if (chance(0.25)) return permutation();
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  }
};

}  // namespace sweeps
