// SPDX-License-Identifier: BSD-3-Clause
#include "bv/rectangle_pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/simplex.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// Beyond this many steps only rounding moves the direction.
constexpr int kMaxSteps = 24;
/// Accuracy of the bound, relative to it.
constexpr double kAccuracy = 1e-3;
/// m. Shorter directions lose digits of their length, whose square underflows.
constexpr double kShortest = 1e-145;

/// The point of the difference (second rectangle minus first) that is least far along `n`.
Vector3d supportAgainst(const RectanglePair& p, const Vector3d& n) {
  const double first = std::copysign(p.halfB.x(), n.dot(p.firstAxis));
  const double second = std::copysign(p.halfB.y(), n.dot(p.secondAxis));
  Vector3d w = p.offset - first * p.firstAxis - second * p.secondAxis;
  w.x() -= std::copysign(p.halfA.x(), n.x());
  w.y() -= std::copysign(p.halfA.y(), n.y());
  return w;
}

/// m; GJK (Gilbert, Johnson, Keerthi 1988) on the difference of the rectangles. Returns the largest
/// gap proven along any direction tried. The least n . w over the difference is at the support
/// point, whatever n is, so the bound is valid even if the search goes badly. Ends when the bound
/// exceeds `enough`, when the rectangles are known to come within the radii, or on convergence.
double rectangleGap(const RectanglePair& p, double enough) {
  Simplex simplex;
  Vector3d n = p.offset;
  double distance = std::numeric_limits<double>::infinity();
  double proven = 0.0;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double length = n.norm();
    if (!(length > kShortest)) break;
    const Vector3d w = supportAgainst(p, n);
    const double gap = n.dot(w) / length;
    if (gap > proven) proven = gap;
    if (proven > enough) break;
    if (distance - proven <= kAccuracy * (proven - p.radii)) break;
    if (simplex.contains(w)) break;
    simplex.add(Vector3d::Zero(), w);
    const Vector3d nearest = simplex.reduceToNearest();
    const double reached = nearest.norm();
    if (!(reached < distance) || !(reached > p.radii) || simplex.size == 4) break;
    distance = reached;
    n = nearest;
  }
  return proven;
}

}  // namespace

bool separated(const RectanglePair& pair) {
  const double needed = pair.radii + pair.margin;
  return rectangleGap(pair, needed) > needed;
}

double gapBound(const RectanglePair& pair) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double bound = rectangleGap(pair, kInfinity) - pair.radii - pair.margin;
  return bound > 0.0 && bound < kInfinity ? bound : 0.0;
}

}  // namespace swept::detail
