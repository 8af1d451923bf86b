// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <limits>

namespace swept::detail {

/// A tetrahedron with its apex at the origin.
struct Cone {
  Eigen::Vector3d a;
  Eigen::Vector3d b;
  Eigen::Vector3d c;

  /// x with x0 a + x1 b + x2 c = point, not finite for a flat cone.
  Eigen::Vector3d coordinates(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d bc = b.cross(c);
    return Eigen::Vector3d(point.dot(bc), point.dot(c.cross(a)), point.dot(a.cross(b))) / a.dot(bc);
  }

  enum class Part : std::uint8_t { Base, Tetrahedron };

  /// Distance of `point` from some point of that part: an upper bound of the distance from it, up
  /// to the rounding of these few operations. The weights are clamped to valid ones before the
  /// distance is measured, so the bound holds however inaccurate they are. Correcting them by the
  /// remainder makes up for flat tetrahedra.
  double distanceBound(const Eigen::Vector3d& point, Part part) const {
    constexpr int kCorrections = 3;
    double bound = std::numeric_limits<double>::infinity();
    Eigen::Vector3d weights = coordinates(point);
    for (int i = 0; i <= kCorrections; ++i) {
      weights = weights.cwiseMax(0.0);
      const double sum = weights.sum();
      if (part == Part::Base || sum > 1.0) weights /= sum;
      if (!weights.allFinite()) break;
      const Eigen::Vector3d left = point - (weights[0] * a + weights[1] * b + weights[2] * c);
      bound = std::min(bound, left.norm());
      weights += coordinates(left);
    }
    return bound;
  }
};

}  // namespace swept::detail
