// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "narrowphase/convex.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept::detail {

/// Signed distance of two bounded convex bodies by GJK and EPA; `guess` is a direction to start
/// with, or zero.
SignedDistanceResult signedByEpa(const Convex& a, const Convex& b,
                                 const Eigen::Isometry3d& a_from_b, const Eigen::Vector3d& guess,
                                 double tolerance);

/// The deepest points of two cores that overlap by `depth` along `result.normal`, the shortest way
/// out: moved slightly farther than that, the cores have their nearest points there.
void deepestPoints(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b,
                   double depth, SignedDistanceResult& result);

}  // namespace swept::detail
