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

/// A ball that contains `points` for any `center`: the radius is measured, not inferred.
BoundingSphere ballAround(const Eigen::Vector3d& center, std::span<const Eigen::Vector3d> points);

/// The smallest ball that contains `points`, which are not empty, up to rounding. Squares of
/// coordinates below 1e-150 and above 1e150 underflow or overflow, and the ball may then be the one
/// about the middle of their box. It pivots to the point farthest from the present ball (Gärtner
/// 1999, "Fast and robust smallest enclosing balls"), which takes some ten passes over all points.
BoundingSphere smallBall(std::span<const Eigen::Vector3d> points);

}  // namespace swept::detail
