// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "geometry/point_text.hpp"
#include "geometry/small_ball.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {
namespace {

using detail::aboveRounding;

void requireSize(std::string_view name, double value) {
  if (value >= 0.0 && std::isfinite(value)) return;
  std::ostringstream message;
  message << name << " is " << value << "; allowed: finite and not negative";
  throw std::invalid_argument(message.str());
}

/// Length of the normal.
double requireNormal(std::string_view name, const Eigen::Vector3d& normal, double offset) {
  const double length = std::hypot(normal.x(), normal.y(), normal.z());
  if (std::isnormal(length) && std::isfinite(offset / length)) return length;
  std::ostringstream message;
  message << name << " has normal " << detail::pointText(normal) << " and offset " << offset
          << "; allowed: finite numbers, a normal that is not zero";
  if (normal.allFinite() && !normal.isZero(0.0)) {
    message << ", of a length from " << std::numeric_limits<double>::min() << " to "
            << std::numeric_limits<double>::max() << " by which the offset can be divided";
  }
  throw std::invalid_argument(message.str());
}

Aabb boxOf(std::span<const Eigen::Vector3d> points) {
  Aabb box{points.front(), points.front()};
  for (const Eigen::Vector3d& point : points) {
    box.lower = box.lower.cwiseMin(point);
    box.upper = box.upper.cwiseMax(point);
  }
  return box;
}

struct SphereOf {
  BoundingSphere operator()(const Sphere& sphere) const {
    return {Eigen::Vector3d::Zero(), sphere.radius};
  }
  BoundingSphere operator()(const Box& box) const {
    const Eigen::Vector3d& half = box.halfExtents;
    return {Eigen::Vector3d::Zero(), aboveRounding(std::hypot(half.x(), half.y(), half.z()))};
  }
  BoundingSphere operator()(const Cylinder& cylinder) const {
    return {Eigen::Vector3d::Zero(),
            aboveRounding(std::hypot(cylinder.radius, cylinder.halfLength))};
  }
  BoundingSphere operator()(const Capsule& capsule) const {
    return {Eigen::Vector3d::Zero(), aboveRounding(capsule.radius + capsule.halfLength)};
  }
  BoundingSphere operator()(const Cone& cone) const {
    // The ball through the apex and the base circle, unless the base is the wider part.
    const double height = 2.0 * cone.halfLength;
    if (!(cone.radius < height)) {
      const double radius = aboveRounding(std::max(cone.radius, height));
      return {Eigen::Vector3d(0.0, 0.0, -cone.halfLength), radius};
    }
    const double lift = 0.5 * (height - cone.radius * (cone.radius / height));
    return {Eigen::Vector3d(0.0, 0.0, lift - cone.halfLength),
            aboveRounding(std::max(std::hypot(cone.radius, lift), height - lift))};
  }
  BoundingSphere operator()(const Ellipsoid& ellipsoid) const {
    return {Eigen::Vector3d::Zero(), ellipsoid.semiAxes.maxCoeff()};
  }
  BoundingSphere operator()(const Triangle& triangle) const {
    return detail::smallBall(triangle.corners);
  }
  BoundingSphere operator()(const Plane&) const { return everywhere(); }
  BoundingSphere operator()(const HalfSpace&) const { return everywhere(); }
  BoundingSphere operator()(const ConvexHull& hull) const {
    BoundingSphere ball = hull.ball();
    ball.radius = aboveRounding(ball.radius + hull.error());
    return ball;
  }
  BoundingSphere operator()(const TriangleMesh& mesh) const {
    return detail::ballAround(mesh.hull().ball().center, mesh.vertices());
  }
  BoundingSphere operator()(const PointCloud& cloud) const {
    BoundingSphere ball = detail::ballAround(cloud.hull().ball().center, cloud.points());
    ball.radius = aboveRounding(ball.radius + cloud.largestRadius());
    return ball;
  }

 private:
  static BoundingSphere everywhere() {
    return {Eigen::Vector3d::Zero(), std::numeric_limits<double>::infinity()};
  }
};

struct BoxOf {
  Aabb operator()(const Sphere& sphere) const { return symmetric(sphere.radius, sphere.radius); }
  Aabb operator()(const Box& box) const { return {-box.halfExtents, box.halfExtents}; }
  Aabb operator()(const Cylinder& cylinder) const {
    return symmetric(cylinder.radius, cylinder.halfLength);
  }
  Aabb operator()(const Capsule& capsule) const {
    return symmetric(capsule.radius, aboveRounding(capsule.radius + capsule.halfLength));
  }
  Aabb operator()(const Cone& cone) const { return symmetric(cone.radius, cone.halfLength); }
  Aabb operator()(const Ellipsoid& ellipsoid) const {
    return {-ellipsoid.semiAxes, ellipsoid.semiAxes};
  }
  Aabb operator()(const Triangle& triangle) const { return boxOf(triangle.corners); }
  Aabb operator()(const Plane&) const { return everywhere(); }
  Aabb operator()(const HalfSpace&) const { return everywhere(); }
  Aabb operator()(const ConvexHull& hull) const {
    return grown(boxOf(hull.vertices()), hull.error());
  }
  Aabb operator()(const TriangleMesh& mesh) const { return boxOf(mesh.vertices()); }
  Aabb operator()(const PointCloud& cloud) const {
    return grown(boxOf(cloud.points()), cloud.largestRadius());
  }

 private:
  static Aabb everywhere() {
    const auto all = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    return {-all, all};
  }
  static Aabb grown(Aabb box, double by) {
    if (!(by > 0.0)) return box;
    // A sum of opposite signs rounds by its result, which is smaller than the terms; growing by a
    // few epsilons of the coordinates covers it.
    const double scale = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
    const double reach = aboveRounding(by + std::numeric_limits<double>::epsilon() * scale);
    box.lower.array() -= reach;
    box.upper.array() += reach;
    return box;
  }
  static Aabb symmetric(double radial, double axial) {
    const Eigen::Vector3d half(radial, radial, axial);
    return {-half, half};
  }
};

}  // namespace

Sphere makeSphere(double radius) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, radius] { return makeSphere(radius); });
  }
  requireSize("sphere radius", radius);
  return {radius};
}

Box makeBox(const Eigen::Vector3d& fullExtents) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return makeBox(fullExtents); });
  }
  requireSize("box size x", fullExtents.x());
  requireSize("box size y", fullExtents.y());
  requireSize("box size z", fullExtents.z());
  return {0.5 * fullExtents};
}

Cylinder makeCylinder(double radius, double fullLength) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, radius, fullLength] { return makeCylinder(radius, fullLength); });
  }
  requireSize("cylinder radius", radius);
  requireSize("cylinder length", fullLength);
  return {radius, 0.5 * fullLength};
}

Capsule makeCapsule(double radius, double segmentLength) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, radius, segmentLength] { return makeCapsule(radius, segmentLength); });
  }
  requireSize("capsule radius", radius);
  requireSize("capsule length", segmentLength);
  return {radius, 0.5 * segmentLength};
}

Cone makeCone(double radius, double fullHeight) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, radius, fullHeight] { return makeCone(radius, fullHeight); });
  }
  requireSize("cone radius", radius);
  requireSize("cone height", fullHeight);
  return {radius, 0.5 * fullHeight};
}

Ellipsoid makeEllipsoid(const Eigen::Vector3d& semiAxes) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return makeEllipsoid(semiAxes); });
  }
  requireSize("ellipsoid semi-axis x", semiAxes.x());
  requireSize("ellipsoid semi-axis y", semiAxes.y());
  requireSize("ellipsoid semi-axis z", semiAxes.z());
  return {semiAxes};
}

Triangle makeTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      const Eigen::Vector3d& c) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return makeTriangle(a, b, c); });
  }
  Triangle triangle{{a, b, c}};
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d& corner = triangle.corners[i];
    if (corner.allFinite()) continue;
    std::ostringstream message;
    message << "triangle corner " << i << " is " << detail::pointText(corner)
            << "; allowed: finite coordinates";
    throw std::invalid_argument(message.str());
  }
  return triangle;
}

Plane makePlane(const Eigen::Vector3d& normal, double offset) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, offset] { return makePlane(normal, offset); });
  }
  const double length = requireNormal("plane", normal, offset);
  return {normal / length, offset / length};
}

HalfSpace makeHalfSpace(const Eigen::Vector3d& normal, double offset) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, offset] { return makeHalfSpace(normal, offset); });
  }
  const double length = requireNormal("half-space", normal, offset);
  return {normal / length, offset / length};
}

BoundingSphere boundingSphere(const Shape& shape) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return boundingSphere(shape); });
  }
  return std::visit(SphereOf{}, shape);
}

Aabb boundingBox(const Shape& shape) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return boundingBox(shape); });
  }
  return std::visit(BoxOf{}, shape);
}

}  // namespace swept
