// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/core/distance.hpp"

/// libccd behind the interface of distance() and collide(), for comparison. Nothing here is proven:
/// its answers come from an iteration that stops by its own tolerance. Support mappings and the
/// walk over meshes are separate from those of the native backend, so that the two can be tested
/// against each other. It must not get planes and half-spaces, which libccd does not know.
namespace swept::detail {

/// libccd gives only yes or no, so bisection finds a distance: the least r for which `a` grown by a
/// ball of radius r meets `b`. `upper` is an estimate, larger than the distance by at most about
/// tolerance::kLibccdDistance if neither `enough` nor `contact` stopped the query. `lower`, the
/// points and the normal stay zero. If libccd does not decide in 10 000 support evaluations whether
/// two pieces meet, `upper` is that of the others.
DistanceResult libccdDistance(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                              const DistanceOptions& options);

/// Estimate; Unknown for a non-finite pose, and if libccd does not decide (see above).
Contact libccdIntersect(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b);

}  // namespace swept::detail
