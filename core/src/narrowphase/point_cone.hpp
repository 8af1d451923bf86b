// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "narrowphase/core_gap.hpp"

namespace swept::detail {

/// On a cone, in the half-plane of the axis and the point: a triangle with the slope from the rim
/// to the apex, of length `slant`, as its outer side.
///
/// Beyond the rim and the apex the offset is taken in the slope's own directions, whose signs have
/// just been tested: the normal then lies in the corner's normal cone however close the point is,
/// and separates by the whole distance.
[[gnu::always_inline]] inline bool closestPointOn(ConeCore, const Convex& cone,
                                                  const Eigen::Vector3d& p, ClosestPoint& closest) {
  const double across = p.x() * p.x() + p.y() * p.y();
  if (!(across < 1e280) || (across > 0.0 && across < 1e-280)) return false;
  const double rho = std::sqrt(across);
  const double x = rho > 0.0 ? p.x() / rho : 1.0;
  const double y = rho > 0.0 ? p.y() / rho : 0.0;
  const double radius = cone.size.x();
  const double height = 2.0 * cone.size.z();
  const double slant = std::sqrt(radius * radius + height * height);
  if (!(slant > 1e-140 && slant < 1e140)) return false;
  const double cosine = height / slant;  // of the slope's outward normal with the radial direction
  const double sine = radius / slant;
  const double out = rho - radius;
  const double up = p.z() + cone.size.z();  // over the base
  const double side = out * cosine + up * sine;
  const double along = up * cosine - out * sine;  // from the rim
  const auto corner = [&](double offsetRho, double offsetZ, double cornerRho, double cornerZ) {
    closest.distance = std::sqrt(offsetRho * offsetRho + offsetZ * offsetZ);
    if (!(closest.distance > 1e-140)) return false;
    const double share = offsetRho / closest.distance;
    closest.normal = {share * x, share * y, offsetZ / closest.distance};
    closest.point = {cornerRho * x, cornerRho * y, cornerZ};
    return true;
  };
  if (up < 0.0 && out > 0.0) return corner(out, up, radius, -cone.size.z());
  // Not only above the slope: for a cone without width or height, the slope is everything.
  if (up >= 0.0 && side >= 0.0) {
    const double past = along - slant;
    if (along <= 0.0) {
      return corner(side * cosine - along * sine, side * sine + along * cosine, radius,
                    -cone.size.z());
    }
    if (past >= 0.0) {
      return corner(side * cosine - past * sine, side * sine + past * cosine, 0.0, cone.size.z());
    }
  }
  if (side > -up) {
    closest.distance = side;
    closest.normal = {cosine * x, cosine * y, sine};
    closest.point = p - side * closest.normal;
  } else {
    closest.distance = -up;
    closest.normal = {0.0, 0.0, -1.0};
    closest.point = {p.x(), p.y(), -cone.size.z()};
  }
  return true;
}

}  // namespace swept::detail
