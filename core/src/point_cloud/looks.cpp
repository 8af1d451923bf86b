// SPDX-License-Identifier: BSD-3-Clause
#include "point_cloud/looks.hpp"

#include "narrowphase/piecewise.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"
#include "swept/core/solid_depth.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d placedAt(const Vector3d& position) {
  return Isometry3d(Eigen::Translation3d(position));
}

// The ball of a point touches the shape at all positions of the point in a touching set, and at
// none in a free one.
Certificate touchingBall(const Vector3d& center, double radius) {
  return {Certificate::Form::Ball, true, center, radius};
}
Certificate freeBall(const Vector3d& center, double radius) {
  return {Certificate::Form::Ball, false, center, radius};
}
Certificate freeHalfSpace(const Vector3d& normal, double offset) {
  return {Certificate::Form::HalfSpace, false, normal, offset};
}

Vector3d unitOrZero(const Vector3d& way) {
  const double length = way.norm();
  return length > 0.0 ? Vector3d(way / length) : Vector3d::Zero();
}

/// From a distance in [lower, upper] between the position and the shape.
Finding outside(const Vector3d& position, double radius, double lower, double upper) {
  Finding finding;
  finding.clearance = (upper < std::numeric_limits<double>::infinity() ? upper : lower) - radius;
  if (lower > radius) finding.proof = freeBall(position, lower - radius);
  if (upper < radius) finding.proof = touchingBall(position, radius - upper);
  return finding;
}

/// From a ball of radius `depth` around the position that is proven to be in the shape.
Finding inside(const Vector3d& position, double radius, double depth) {
  Finding finding;
  finding.clearance = -(radius + depth);
  if (radius + depth > 0.0) finding.proof = touchingBall(position, radius + depth);
  return finding;
}

}  // namespace

ShapeLook::ShapeLook(const Shape& shape)
    : shape_(shape),
      point_(Sphere{0.0}),
      shapeSide_(Side::of(shape)),
      pointSide_(Side::of(point_)) {}

Finding ShapeLook::at(const Vector3d& position, double radius, double tolerance) const {
  return shapeSide_.mesh != nullptr ? atMesh(position, radius, tolerance)
                                    : atOther(position, radius, tolerance);
}

// The ball that reaches to the nearest triangle is wholly enclosed exactly if its center is.
Finding ShapeLook::atMesh(const Vector3d& position, double radius, double tolerance) const {
  PieceGoal goal;
  goal.surfaces = true;
  goal.tolerance = tolerance;
  const PieceResult surface =
      searchPieces(shapeSide_, pointSide_, placedAt(position), Vector3d::Zero(), goal);
  const Vector3d away = unitOrZero(position - surface.pointA);
  if (surface.lower > 0.0 && shapeSide_.mesh->encloses(position)) {
    Finding finding = inside(position, radius, surface.lower);
    finding.outward = -away;
    return finding;
  }
  Finding finding = outside(position, radius, surface.lower, surface.upper);
  finding.outward = away;
  return finding;
}

Finding ShapeLook::atOther(const Vector3d& position, double radius, double tolerance) const {
  DistanceOptions options;
  options.tolerance = tolerance;
  const DistanceResult apart = distance(shape_, point_, placedAt(position), options);
  if (apart.lower > 0.0) {
    Finding finding = outside(position, radius, apart.lower, apart.upper);
    finding.outward = unitOrZero(position - apart.pointA);
    // The whole shape is behind the plane.
    if (apart.lower > radius && apart.normal.squaredNorm() > 0.0) {
      finding.proof =
          freeHalfSpace(apart.normal, apart.normal.dot(position) - (apart.lower - radius));
    }
    return finding;
  }
  if (shapeSide_.cloud != nullptr) {
    return inside(position, radius - apart.upper, solidDepth(shape_, position));
  }
  const SignedDistanceResult deep = signedDistance(shape_, point_, placedAt(position), tolerance);
  Finding finding = inside(position, radius, -deep.upper);
  finding.outward = deep.normal;
  return finding;
}

Finding lookAtBall(const Vector3d& position, double radius) {
  const double apart = position.norm();
  Finding finding;
  finding.clearance = apart - radius;
  finding.outward = apart > 0.0 ? Vector3d(position / apart) : Vector3d::UnitX();
  if (apart > radius) {
    finding.proof = freeHalfSpace(finding.outward, radius);
  } else {
    finding.proof = touchingBall(Vector3d::Zero(), radius);
  }
  return finding;
}

}  // namespace swept::detail
