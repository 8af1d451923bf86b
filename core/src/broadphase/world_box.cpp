// SPDX-License-Identifier: BSD-3-Clause
#include "broadphase/world_box.hpp"

#include <cmath>
#include <limits>
#include <span>

#include "bvh/wide_bvh.hpp"
#include "geometry/error_model.hpp"

namespace swept::detail {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// The box of `center` +- `half`, both in the world; `scale`: the sum of the magnitudes of what a
/// coordinate of the centre is made of.
Aabb grown(const Vector3d& center, const Vector3d& half, const Vector3d& scale) {
  const Vector3d reach = (half + kWorldBoxRounding * (scale + half)).array() +
                         16.0 * std::numeric_limits<double>::min();
  return {center - reach, center + reach};
}

/// Extents of the rotated shape along the world's axes, which are the rows of the rotation.
class Placed {
 public:
  Placed(const Isometry3d& world_from_shape, BoxFit fit) : pose_(world_from_shape), fit_(fit) {}

  Aabb operator()(const Sphere& sphere) const {
    return aroundOrigin(Vector3d::Constant(sphere.radius));
  }
  Aabb operator()(const Box& box) const { return aroundOrigin(absolute() * box.halfExtents); }
  Aabb operator()(const Cylinder& cylinder) const {
    return aroundOrigin(cylinder.halfLength * absolute().col(2) + cylinder.radius * radial());
  }
  Aabb operator()(const Capsule& capsule) const {
    return aroundOrigin((capsule.halfLength * absolute().col(2)).array() + capsule.radius);
  }
  Aabb operator()(const Cone& cone) const {
    // The apex and the rim of the base, each on its side.
    const Vector3d apex = cone.halfLength * pose_.linear().col(2);
    const Vector3d rim = cone.radius * radial();
    const Aabb base = around(pose_.translation() - apex, rim, scaleOf(apex));
    const Aabb tip = around(pose_.translation() + apex, Vector3d::Zero(), scaleOf(apex));
    return {base.lower.cwiseMin(tip.lower), base.upper.cwiseMax(tip.upper)};
  }
  Aabb operator()(const Ellipsoid& ellipsoid) const {
    return aroundOrigin((pose_.linear() * ellipsoid.semiAxes.asDiagonal()).rowwise().norm());
  }
  Aabb operator()(const Triangle& triangle) const { return ofPoints(triangle.corners, 0.0); }
  Aabb operator()(const ConvexHull& hull) const { return ofPoints(hull.vertices(), hull.error()); }
  Aabb operator()(const TriangleMesh& mesh) const {
    if (fit_ == BoxFit::Tight) return ofPoints(mesh.vertices(), 0.0);
    return ofTree(mesh.bvh());
  }
  Aabb operator()(const PointCloud& cloud) const {
    if (fit_ == BoxFit::Tight) return ofPoints(cloud.points(), cloud.largestRadius());
    return ofTree(cloud.bvh());
  }
  Aabb operator()(const Plane&) const { return everywhere(); }
  Aabb operator()(const HalfSpace&) const { return everywhere(); }

 private:
  static Aabb everywhere() {
    const auto all = Vector3d::Constant(std::numeric_limits<double>::infinity());
    return {-all, all};
  }
  Eigen::Matrix3d absolute() const { return pose_.linear().cwiseAbs(); }
  /// Extent of the unit disc across the local z axis.
  Vector3d radial() const { return pose_.linear().leftCols<2>().rowwise().norm(); }
  Vector3d scaleOf(const Vector3d& offset) const {
    return offset.cwiseAbs() + pose_.translation().cwiseAbs();
  }
  static Aabb around(const Vector3d& center, const Vector3d& half, const Vector3d& scale) {
    return grown(center, half, scale);
  }
  Aabb aroundOrigin(const Vector3d& half) const {
    return grown(pose_.translation(), half, pose_.translation().cwiseAbs());
  }
  Aabb ofTree(const WideBvh& bvh) const {
    const TreeBox box = treeBox(bvh);
    const Vector3d scale = absolute() * box.middle.cwiseAbs() + pose_.translation().cwiseAbs();
    return grown(pose_ * box.middle, absolute() * box.half, scale);
  }
  /// Box of points that may be off by `error`, in the local frame.
  Aabb ofPoints(std::span<const Vector3d> points, double error) const {
    Vector3d lower = pose_ * points.front(), upper = lower;
    Vector3d largest = points.front().cwiseAbs();
    for (const Vector3d& point : points.subspan(1)) {
      const Vector3d placed = pose_ * point;
      lower = lower.cwiseMin(placed);
      upper = upper.cwiseMax(placed);
      largest = largest.cwiseMax(point.cwiseAbs());
    }
    const Vector3d scale = absolute() * largest + pose_.translation().cwiseAbs();
    const Vector3d blur = error * absolute().rowwise().sum();
    return {grown(lower, blur, scale).lower, grown(upper, blur, scale).upper};
  }

  const Isometry3d& pose_;
  BoxFit fit_;
};

}  // namespace

TreeBox treeBox(const WideBvh& bvh) {
  const Aabb& bounds = bvh.bounds();
  const Vector3d center = bounds.center();
  const Vector3d half = (bounds.upper - center).cwiseMax(center - bounds.lower);
  // Each difference rounds by at most half an epsilon of its result.
  return {center, half + 2.0 * kRoundoff * half};
}

Aabb worldBox(const Shape& shape, const Isometry3d& world_from_shape, BoxFit fit) {
  return std::visit(Placed(world_from_shape, fit), shape);
}

}  // namespace swept::detail
