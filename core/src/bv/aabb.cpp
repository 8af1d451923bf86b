// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/bv/aabb.hpp"

#include <algorithm>

#include "bv/box_pair.hpp"
#include "swept/core/bv/bounding_volume.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

static_assert(BoundingVolume<Aabb>);

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

detail::BoxPair pairOf(const Aabb& a, const Aabb& b, const Isometry3d& a_from_b) {
  detail::BoxPair p;
  const Vector3d middleA = a.center();
  const Vector3d middleB = b.center();
  p.rotation = a_from_b.linear();
  p.offset = p.rotation * middleB + a_from_b.translation() - middleA;
  p.halfA = 0.5 * a.upper - 0.5 * a.lower;
  p.halfB = 0.5 * b.upper - 0.5 * b.lower;
  p.margin = detail::volumeMargin(detail::magnitude(middleA) + detail::magnitude(middleB) +
                                  detail::magnitude(p.halfA) + detail::magnitude(p.halfB) +
                                  detail::magnitude(a_from_b.translation()));
  return p;
}

}  // namespace

Aabb Aabb::fit(std::span<const Vector3d> points) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, points] { return fit(points); });
  }
  if (points.empty()) return {Vector3d::Constant(NAN), Vector3d::Constant(NAN)};
  Vector3d lower = points.front();
  Vector3d upper = points.front();
  Vector3d zero = Vector3d::Zero();  // becomes NaN with the first non-finite coordinate
  for (const Vector3d& p : points) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], p[k]);
      upper[k] = std::max(upper[k], p[k]);
      zero[k] += 0.0 * p[k];
    }
  }
  const double poison = zero.sum();
  return {lower.array() + poison, upper.array() + poison};
}

Aabb Aabb::merge(const Aabb& a, const Aabb& b) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return merge(a, b); });
  }
  // Minimum and maximum may drop a NaN; the product does not.
  const double poison = 0.0 * (a.lower.sum() + b.lower.sum());
  if (!(poison == 0.0) && !(a.lower.allFinite() && b.lower.allFinite())) {
    return {Vector3d::Constant(NAN), Vector3d::Constant(NAN)};
  }
  return {a.lower.cwiseMin(b.lower), a.upper.cwiseMax(b.upper)};
}

Aabb Aabb::inflated(double by) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, by] { return inflated(by); });
  }
  // Each sum rounds by at most half an epsilon of its terms.
  const double rounding = 4e-16 * (by + detail::magnitude(lower) + detail::magnitude(upper));
  return {lower.array() - (by + rounding), upper.array() + (by + rounding)};
}

bool Aabb::overlaps(const Aabb& other, const Isometry3d& a_from_b) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return overlaps(other, a_from_b); });
  }
  return !detail::separatedByFaces(pairOf(*this, other, a_from_b));
}

double Aabb::distanceBound(const Aabb& other, const Isometry3d& a_from_b) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return distanceBound(other, a_from_b); });
  }
  return detail::boundFromSquare(detail::squaredFaceBound(pairOf(*this, other, a_from_b)));
}

}  // namespace swept
