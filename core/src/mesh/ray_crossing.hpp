// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>

#include "geometry/error_model.hpp"

namespace swept::detail {

/// How a ray meets a triangle.
enum class Crossing : std::uint8_t {
  Unsure,   ///< within rounding of the border or of the origin, or NaN
  Miss,     ///< proven
  Along,    ///< proven: once, with the triangle's normal
  Against,  ///< proven: once, against the triangle's normal
};

/// The ray starts at the origin; corners are relative to it, each coordinate rounded once. Every
/// component of `direction` is at most 1 in magnitude.
///
/// The line passes a directed edge on the side given by the sign of a triple product, and the plane
/// at a parameter with the sign of another one. Each is a sum of six products of three factors with
/// fewer than 8 roundings (subtractions of the corners included), so with s and t the largest
/// coordinates of the two corners it is off by less than 8 u * 6 s t, u = 2^-53.
inline Crossing rayCrossing(const Eigen::Vector3d& direction, const Eigen::Vector3d& a,
                            const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  constexpr double kUnderflow = 1e-300;
  const double sizeA = a.cwiseAbs().maxCoeff();
  const double sizeB = b.cwiseAbs().maxCoeff();
  const double sizeC = c.cwiseAbs().maxCoeff();

  // Wholly behind the origin.
  const double ahead = std::max({direction.dot(a), direction.dot(b), direction.dot(c)});
  if (ahead < -kCrossingRounding * std::max({sizeA, sizeB, sizeC}) - kUnderflow)
    return Crossing::Miss;

  const Eigen::Vector3d bc = b.cross(c);
  const double sideBC = direction.dot(bc);
  const double sideCA = direction.dot(c.cross(a));
  const double sideAB = direction.dot(a.cross(b));
  const double errorBC = kCrossingRounding * sizeB * sizeC + kUnderflow;
  const double errorCA = kCrossingRounding * sizeC * sizeA + kUnderflow;
  const double errorAB = kCrossingRounding * sizeA * sizeB + kUnderflow;
  const bool positive = sideBC > errorBC || sideCA > errorCA || sideAB > errorAB;
  const bool negative = sideBC < -errorBC || sideCA < -errorCA || sideAB < -errorAB;
  if (positive && negative) return Crossing::Miss;
  const bool along = sideBC > errorBC && sideCA > errorCA && sideAB > errorAB;
  const bool against = sideBC < -errorBC && sideCA < -errorCA && sideAB < -errorAB;
  if (!along && !against) return Crossing::Unsure;

  const double volume = a.dot(bc);
  const double errorVolume = errorBC * sizeA + kUnderflow;
  if (!(volume > errorVolume) && !(volume < -errorVolume)) return Crossing::Unsure;
  if ((volume > 0.0) != along) return Crossing::Miss;
  return along ? Crossing::Along : Crossing::Against;
}

}  // namespace swept::detail
