// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "narrowphase/core_gap.hpp"

namespace swept::detail {

/// On a cylinder, in the half-plane of the axis and the point.
[[gnu::always_inline]] inline bool closestPointOn(CylinderCore, const Convex& cylinder,
                                                  const Eigen::Vector3d& p, ClosestPoint& closest) {
  const double across = p.x() * p.x() + p.y() * p.y();
  if (!(across < 1e280) || (across > 0.0 && across < 1e-280)) return false;
  const double rho = std::sqrt(across);
  const double x = rho > 0.0 ? p.x() / rho : 1.0;
  const double y = rho > 0.0 ? p.y() / rho : 0.0;
  const double radius = cylinder.size.x();
  const double side = std::copysign(1.0, p.z());
  const double out = rho - radius;
  const double beyond = std::abs(p.z()) - cylinder.size.z();
  if (out > 0.0 && beyond > 0.0) {
    closest.distance = std::sqrt(out * out + beyond * beyond);
    if (!(closest.distance > 1e-140)) return false;
    const double share = out / closest.distance;
    closest.normal = {share * x, share * y, side * (beyond / closest.distance)};
    closest.point = {radius * x, radius * y, side * cylinder.size.z()};
  } else if (out > beyond) {
    closest.distance = out;
    closest.normal = {x, y, 0.0};
    closest.point = {radius * x, radius * y, p.z()};
  } else {
    closest.distance = beyond;
    closest.normal = {0.0, 0.0, side};
    closest.point = {p.x(), p.y(), side * cylinder.size.z()};
  }
  return true;
}

}  // namespace swept::detail
