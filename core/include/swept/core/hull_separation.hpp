// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <limits>

#include "swept/core/separation.hpp"
#include "swept/core/shapes.hpp"

namespace swept {

/// How far apart two moving bodies are along one direction.
struct HullSeparation {
  double atMiddle = -std::numeric_limits<double>::infinity();  ///< m, proven at the middle
  double least = -std::numeric_limits<double>::infinity();     ///< m, proven for the whole interval
};

/// Lower bounds on the separation of the convex hulls of `a` and `b` along `n` (from a to b, a's
/// frame, not zero), and so on the distance of the two, during the interval of `approach`. Nothing
/// is subtracted for `approach.required`. `a_from_b` is the pose of b in a's frame at the middle.
///
/// Unlike ApproachBound::along(), which takes the largest velocity in a ball, this takes each point
/// with its own velocity: what is lost by a long interval is second order where the nearest points
/// move across `n`. Minus infinity: no bound, for a plane or half-space as `a` or with a spin, for
/// errors in `approach`, and for a pose far from rigid (see distance()). NaN for input that is not
/// finite.
HullSeparation hullSeparation(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                              const ApproachBound& approach, const Eigen::Vector3d& n);

}  // namespace swept
