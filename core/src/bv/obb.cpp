// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/bv/obb.hpp"

#include <algorithm>
#include <array>

#include "bv/box_pair.hpp"
#include "bv/extents.hpp"
#include "bv/principal_axes.hpp"
#include "swept/core/bv/bounding_volume.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

static_assert(BoundingVolume<Obb>);

namespace {

using detail::BoxPair;
using detail::Extents;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Obb unboundedBox() {
  return {Matrix3d::Identity(), Vector3d::Constant(NAN), Vector3d::Constant(NAN)};
}

/// Lemma (containment): the extents are measured from `origin`, a point of the set. Coordinates
/// along an axis round by less than 6 epsilons of the largest difference, the middle by as much and
/// by 2 epsilons of its own magnitude, and so does contains() later. The growth below exceeds their
/// sum.
Obb boxOver(const Matrix3d& axes, const Extents& extents, const Vector3d& origin) {
  const Vector3d local = 0.5 * (extents.lower + extents.upper);
  const Vector3d middle = origin + axes * local;
  const double reach = detail::magnitude(extents.lower) + detail::magnitude(extents.upper);
  const double growth =
      5e-15 * reach + 2e-15 * detail::magnitude(origin) + detail::kVolumeUnderflow;
  return {axes, middle, extents.half().array() + growth};
}

BoxPair pairOf(const Obb& a, const Obb& b, const Matrix3d& axesB, const Vector3d& offset,
               double magnitudeOfPose) {
  BoxPair p;
  p.rotation.noalias() = a.axes.transpose() * axesB;
  p.offset.noalias() = a.axes.transpose() * offset;
  p.halfA = a.halfExtents;
  p.halfB = b.halfExtents;
  p.margin = detail::volumeMargin(magnitudeOfPose + detail::magnitude(a.middle) +
                                  detail::magnitude(b.middle) + detail::magnitude(a.halfExtents) +
                                  detail::magnitude(b.halfExtents));
  return p;
}

BoxPair pairOf(const Obb& a, const Obb& b) {
  return pairOf(a, b, b.axes, b.middle - a.middle, 0.0);
}

BoxPair pairOf(const Obb& a, const Obb& b, const Isometry3d& a_from_b) {
  const Matrix3d rotation = a_from_b.linear();
  const Vector3d offset = rotation * b.middle + a_from_b.translation() - a.middle;
  return pairOf(a, b, rotation * b.axes, offset, detail::magnitude(a_from_b.translation()));
}

/// Interval of a box along a unit vector, from `origin`.
void include(const Obb& box, const Matrix3d& axes, const Vector3d& origin, Extents& extents) {
  const Vector3d middle = axes.transpose() * (box.middle - origin);
  const Vector3d reach = (axes.transpose() * box.axes).cwiseAbs() * box.halfExtents;
  extents.lower = extents.lower.cwiseMin(middle - reach);
  extents.upper = extents.upper.cwiseMax(middle + reach);
}

std::array<Vector3d, 16> cornersOf(const Obb& a, const Obb& b) {
  std::array<Vector3d, 16> corners;
  for (int i = 0; i < 8; ++i) {
    const Vector3d sign(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0);
    corners[i] = a.middle + a.axes * a.halfExtents.cwiseProduct(sign);
    corners[i + 8] = b.middle + b.axes * b.halfExtents.cwiseProduct(sign);
  }
  return corners;
}

/// This many points of a large set are enough to choose axes.
constexpr std::size_t kSample = 64;

std::span<const Vector3d> sampleOf(std::span<const Vector3d> points,
                                   std::array<Vector3d, kSample>& buffer) {
  if (points.size() <= kSample) return points;
  for (std::size_t i = 0; i < kSample; ++i) buffer[i] = points[i * points.size() / kSample];
  return buffer;
}

/// The candidate axes whose box has the least surface.
Matrix3d chooseAxes(std::span<const Vector3d> points) {
  // Principal axes of few points depend on how the surface is cut into triangles more than on its
  // shape; the first triangle's axes fit flat pieces.
  constexpr std::size_t kFew = 12;
  Matrix3d axes = Matrix3d::Identity();
  double least = detail::extentsAlong(points, axes).area();
  const auto consider = [&](const Matrix3d& candidate) {
    const double area = detail::extentsAlong(points, candidate).area();
    if (!(area < least)) return;
    axes = candidate;
    least = area;
  };
  if (points.size() >= 3 && points.size() <= kFew) {
    consider(detail::triangleAxes(points[0], points[1], points[2]));
  }
  if (points.size() != 3) consider(detail::principalAxes(detail::scatterOf(points)));
  return axes;
}

}  // namespace

Obb Obb::fit(std::span<const Vector3d> points) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, points] { return fit(points); });
  }
  if (points.empty()) return unboundedBox();
  std::array<Vector3d, kSample> buffer;
  Matrix3d axes = chooseAxes(sampleOf(points, buffer));
  Extents extents = detail::extentsAlong(points, axes);
  if (!extents.finite) return unboundedBox();
  detail::sortLongestFirst(axes, extents);
  return boxOver(axes, extents, points.front());
}

Obb Obb::merge(const Obb& a, const Obb& b) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return merge(a, b); });
  }
  if (!(a.halfExtents + b.halfExtents).allFinite()) return unboundedBox();
  const Vector3d& origin = a.middle;
  Matrix3d axes;
  Extents extents;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Matrix3d& candidate) {
    Extents along{Vector3d::Zero(), Vector3d::Zero()};
    include(a, candidate, origin, along);
    include(b, candidate, origin, along);
    if (!(along.area() < least)) return;
    least = along.area();
    axes = candidate;
    extents = along;
  };
  consider(a.axes);
  consider(b.axes);
  consider(detail::principalAxes(detail::scatterOf(cornersOf(a, b))));
  if (!(least < std::numeric_limits<double>::infinity())) return unboundedBox();
  detail::sortLongestFirst(axes, extents);
  Obb merged = boxOver(axes, extents, origin);
  // The boxes' own middles carry the rounding of their coordinates.
  merged.halfExtents.array() += detail::kVolumeRounding * detail::magnitude(b.middle);
  return merged;
}

Obb Obb::inflated(double by) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, by] { return inflated(by); });
  }
  const double growth = by + 4e-16 * (by + detail::magnitude(halfExtents));
  return {axes, middle, halfExtents.array() + growth};
}

bool Obb::overlaps(const Obb& other) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return overlaps(other); });
  }
  const BoxPair p = pairOf(*this, other);
  return !detail::separatedByFaces(p) && !detail::separatedByEdges(p);
}

bool Obb::overlaps(const Obb& other, const Isometry3d& a_from_b) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return overlaps(other, a_from_b); });
  }
  const BoxPair p = pairOf(*this, other, a_from_b);
  return !detail::separatedByFaces(p) && !detail::separatedByEdges(p);
}

double Obb::distanceBound(const Obb& other, const Isometry3d& a_from_b) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return distanceBound(other, a_from_b); });
  }
  const BoxPair p = pairOf(*this, other, a_from_b);
  return detail::boundFromSquare(
      std::max(detail::squaredFaceBound(p), detail::squaredEdgeBound(p)));
}

bool Obb::contains(const Vector3d& p) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return contains(p); });
  }
  const Vector3d local = axes.transpose() * (p - middle);
  for (int k = 0; k < 3; ++k) {
    if (std::abs(local[k]) > halfExtents[k]) return false;
  }
  return true;
}

}  // namespace swept
