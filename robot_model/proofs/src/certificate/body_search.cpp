// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/body_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "swept/core/axis_frame.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kRim = 16;  ///< points on the rim of a disc

Isometry3d along(const Vector3d& axis, const Vector3d& middle) {
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = axisFrame(axis);
  pose.translation() = middle;
  return pose;
}

/// The element itself, where the library has its shape, otherwise the hull of its points.
CertifiedBody::Part shapeOfElement(const verify::Element& element) {
  if (element.ellipsoid) {
    const Vector3d axes = element.ellipsoid->axes.colwise().norm();
    Isometry3d pose = Isometry3d::Identity();
    pose.translation() = element.ellipsoid->center;
    pose.linear() = element.ellipsoid->axes * axes.cwiseInverse().asDiagonal();
    if (axes.minCoeff() > 0.0) return {makeEllipsoid(axes), pose};
    return {makeSphere(axes.maxCoeff()), pose};
  }
  if (!element.discs.empty()) {
    const verify::Element::Disc& disc = element.discs.front();
    const bool cone = element.discs.size() == 1;
    const Vector3d tip = cone ? element.points.front() : element.discs.back().center;
    const double length = (tip - disc.center).norm();
    const Isometry3d pose = along(disc.axis, 0.5 * (tip + disc.center));
    if (cone) return {makeCone(disc.radius, length), pose};
    return {makeCylinder(disc.radius, length), pose};
  }
  if (element.points.size() == 1) {
    return {makeSphere(element.radius), Isometry3d(Eigen::Translation3d(element.points.front()))};
  }
  if (element.points.size() == 2 && element.radius > 0.0) {
    const Vector3d way = element.points[1] - element.points[0];
    const Vector3d axis = way.norm() > 0.0 ? Vector3d(way.normalized()) : Vector3d::UnitZ();
    return {makeCapsule(element.radius, way.norm()),
            along(axis, 0.5 * (element.points[0] + element.points[1]))};
  }
  return {ConvexHull::of(element.points), Isometry3d::Identity()};
}

void addPoints(const verify::Element& element, std::vector<Vector3d>& points) {
  points.insert(points.end(), element.points.begin(), element.points.end());
  for (const verify::Element::Disc& disc : element.discs) {
    const Isometry3d pose = along(disc.axis, disc.center);
    for (int i = 0; i < kRim; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kRim;
      points.emplace_back(
          pose * Vector3d(disc.radius * std::cos(angle), disc.radius * std::sin(angle), 0.0));
    }
  }
  if (!element.ellipsoid) return;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      points.emplace_back(element.ellipsoid->center + side * element.ellipsoid->axes.col(axis));
}

}  // namespace

SearchedBody::SearchedBody(const verify::Body& body, const CertifiedBody& source)
    : body_(body), shapes_(body.nodes().size()) {
  for (const CertifiedBody::Part& part : source.parts)
    if (!std::holds_alternative<Plane>(part.shape) &&
        !std::holds_alternative<HalfSpace>(part.shape))
      parts_.push_back(part);
}

const CertifiedBody::Part& SearchedBody::shapeOf(int node) {
  auto& shape = shapes_[static_cast<std::size_t>(node)];
  if (shape) return *shape;
  const verify::Body::Node& range = body_.nodes()[static_cast<std::size_t>(node)];
  if (range.last == range.first + 1) {
    shape = shapeOfElement(body_.elements()[range.first]);
  } else {
    std::vector<Vector3d> points;
    for (std::size_t i = range.first; i < range.last; ++i) addPoints(body_.elements()[i], points);
    shape = CertifiedBody::Part{ConvexHull::of(points), Isometry3d::Identity()};
  }
  return *shape;
}

double SearchedBody::sizeOf(int node) {
  return boundingSphere(shapeOf(node).shape).radius;
}

double SearchedBody::grownBy(int node) const {
  if (body_.isLeaf(node)) return 0.0;
  const verify::Body::Node& range = body_.nodes()[static_cast<std::size_t>(node)];
  double most = 0.0;
  for (std::size_t i = range.first; i < range.last; ++i)
    most = std::max(most, body_.elements()[i].radius);
  return most;
}

}  // namespace swept
