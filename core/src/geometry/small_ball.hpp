// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>

#include "geometry/error_model.hpp"
#include "swept/core/bounding_sphere.hpp"

namespace swept::detail {

/// Upper bound of a length that was computed with fewer than 16 rounded operations on non-negative
/// terms; the last term covers results that underflow.
inline double aboveRounding(double length) {
  return length * kLengthUp + std::numeric_limits<double>::min();
}

/// Contains `points` whatever `center` is: the radius is measured, not inferred.
BoundingSphere ballAround(const Eigen::Vector3d& center, std::span<const Eigen::Vector3d> points);

/// Contains `points`, of which there is at least one, and is the smallest ball that does but for
/// rounding: squares of coordinates beyond 1e-150 and 1e150 round to nothing or to infinity, and
/// the ball may be the one about the middle of their box. Pivots to the point farthest from the
/// ball of those so far (Gärtner 1999, "Fast and robust smallest enclosing balls"), which takes
/// some ten looks at all points.
BoundingSphere smallBall(std::span<const Eigen::Vector3d> points);

}  // namespace swept::detail
