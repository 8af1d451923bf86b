// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/core/distance.hpp"

/// libccd behind the interface of distance() and collide(). It has yes/no answers only, so a distance
/// is found by bisection: the least r for which `a` grown by a ball of radius r meets `b`.
namespace swept::detail {

DistanceResult libccdDistance(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                              const DistanceOptions& options);
bool libccdIntersect(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b);

}  // namespace swept::detail
