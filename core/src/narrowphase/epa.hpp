// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "geometry/simplex.hpp"
#include "narrowphase/convex.hpp"

namespace swept::detail {

/// Penetration depth of two cores whose difference contains the origin, as an interval.
struct EpaResult {
  double lower = 0.0;  ///< m, proven: no shorter translation separates the cores
  double upper = 0.0;  ///< m, proven: this one, along `normal`, does
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< unit, from a to b, a's frame
  Eigen::Vector3d pointA =
      Eigen::Vector3d::Zero();  ///< m, deepest point of a's core in b, a's frame
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();  ///< m, of b's core in a, a's frame
  int iterations = 0;                                ///< support evaluations
};

/// Expanding polytope algorithm (van den Bergen 2001): a polytope inside B - A that contains the
/// origin grows by support points until its nearest face lies on the boundary to within
/// `tolerance`. The nearest face bounds the depth from below, the support plane along each normal
/// tried from above. `start` is the simplex with which GJK found the overlap. Stops early, with a
/// wider interval, when rounding spoils the polytope or its storage is full.
EpaResult epa(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b,
              const Simplex& start, double tolerance);

}  // namespace swept::detail
