// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/core/distance.hpp"

/// libccd behind the interface of distance() and collide(), for comparison. Nothing here is proven:
/// its answers are those of an iteration that stops by a tolerance of its own. Support mappings and
/// the walk over meshes are separate from those of the native backend, so that the two can be
/// tested against each other. Planes and half-spaces, which libccd does not know, are not for it.
namespace swept::detail {

/// libccd has yes/no answers only, so a distance is found by bisection: the least r for which `a`
/// grown by a ball of radius r meets `b`. `upper` is an estimate, larger than the distance by no
/// more than about tolerance::kLibccdDistance when neither `enough` nor `contact` stopped the
/// query; `lower`, the points and the normal stay zero. Where libccd does not find out in 10 000
/// support evaluations whether two pieces meet, `upper` is that of the others.
DistanceResult libccdDistance(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                              const DistanceOptions& options);

/// Estimate; Unknown for a non-finite pose, and where libccd does not find out (see above).
Contact libccdIntersect(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b);

}  // namespace swept::detail
