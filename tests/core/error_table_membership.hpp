// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "error_table_body.hpp"
#include "reference_distance.hpp"

namespace error_table {

/// Nearest of the triangles, those out of question left out in double precision.
inline Real distanceToSurface(const Body& body, const Point& p) {
  const Vector3d near = rounded(p);
  std::vector<double> apart;
  for (const Eigen::Vector3i& f : body.surface) {
    apart.push_back(
        reference::pointTriangle(near, {body.points[f[0]], body.points[f[1]], body.points[f[2]]}));
  }
  const double least = *std::min_element(apart.begin(), apart.end());
  Real best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < apart.size(); ++i) {
    if (apart[i] > least + 1e-9 * (body.extent + least)) continue;
    const Eigen::Vector3i& f = body.surface[i];
    const std::array<Point, 3> t{real(body.points[f[0]]), real(body.points[f[1]]),
                                 real(body.points[f[2]])};
    for (int k = 0; k < 3; ++k) {
      best = std::min(best, oracle::pointSegment(p, t[k], t[(k + 1) % 3]));
    }
    best = oracle::pointFace(p, t, best);
  }
  return sqrt(best);
}

/// Newton on the multiplier of the nearest point; the function is convex and falls, so that the
/// steps from 0 never pass the root.
inline Real distanceToEllipsoid(const Vector3d& semiAxes, const Point& p) {
  const std::array<Real, 3> x{p.x, p.y, p.z};
  Real s = 0;
  for (int step = 0; step < 200; ++step) {
    Real value = -1;
    Real slope = 0;
    for (int i = 0; i < 3; ++i) {
      const Real a = semiAxes[i];
      const Real q = a * x[i] / (a * a + s);
      value += q * q;
      slope -= 2 * q * q / (a * a + s);
    }
    if (value < Real("1e-42")) break;
    s -= value / slope;
  }
  Real squared = 0;
  for (int i = 0; i < 3; ++i) {
    const Real a = semiAxes[i];
    const Real d = s * x[i] / (a * a + s);
    squared += d * d;
  }
  return sqrt(squared);
}

inline Real distanceToCone(const Body& body, const Point& p) {
  const Real r = body.size.x();
  const Real l = body.size.z();
  const Point q{sqrt(p.x * p.x + p.y * p.y), p.z, 0};
  if (q.y >= -l && r * (q.y - l) + 2 * l * q.x <= 0) return 0;
  const Point rim{r, -l, 0};
  return sqrt(
      std::min(oracle::pointSegment(q, {0, l, 0}, rim), oracle::pointSegment(q, {0, -l, 0}, rim)));
}

inline Real distanceToBalls(const Body& body, const Point& p) {
  Real squared = std::numeric_limits<double>::infinity();
  for (const Vector3d& center : body.points) {
    const Point d = p - real(center);
    squared = std::min(squared, d.dot(d));
  }
  return std::max(Real(0), Real(sqrt(squared) - body.radius));
}

/// m. Of a point, in the body's frame, from the body; from its surface where that has triangles.
inline Real distanceTo(const Body& body, const Point& p) {
  const Real zero = 0;
  switch (body.core) {
    case Body::Core::Points:
      if (!body.surface.empty()) return distanceToSurface(body, p);
      if (body.edges.empty()) return distanceToBalls(body, p);
      return std::max(
          zero,
          Real(sqrt(oracle::pointSegment(p, real(body.points.front()), real(body.points.back()))) -
               body.radius));
    case Body::Core::Cylinder: {
      const Real aside = std::max(zero, Real(sqrt(p.x * p.x + p.y * p.y) - body.size.x()));
      const Real above = std::max(zero, Real(abs(p.z) - body.size.z()));
      return sqrt(aside * aside + above * above);
    }
    case Body::Core::Cone:
      return distanceToCone(body, p);
    case Body::Core::Ellipsoid:
      return distanceToEllipsoid(body.size, p);
    case Body::Core::Flat:
      break;
  }
  const Point n = real(body.size);
  const Real above = (n.dot(p) - body.offset) / length(n);
  return body.halfSpace ? std::max(zero, above) : Real(abs(above));
}

}  // namespace error_table
