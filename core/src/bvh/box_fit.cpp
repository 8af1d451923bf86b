// SPDX-License-Identifier: BSD-3-Clause
#include "bvh/box_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bv/extents.hpp"
#include "bv/principal_axes.hpp"
#include "geometry/error_model.hpp"
#include "geometry/single_precision.hpp"

namespace swept::detail {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// m. Boxes that single precision cannot hold are unbounded.
constexpr double kLargest = 1e30;

double halfSurfaceOf(const OrientedBox& box) {
  return halfSurface(2.0 * Vector3d(box.half[0], box.half[1], box.half[2]));
}

OrientedBox unbounded(const Vector3d& origin) {
  OrientedBox box;
  box.center = origin;
  box.half.fill(std::numeric_limits<float>::infinity());
  return box;
}

/// m. No coordinate of the box or of the origin is larger.
Vector3d farthest(const Aabb& bounds, const Vector3d& origin) {
  return bounds.lower.cwiseAbs().cwiseMax(bounds.upper.cwiseAbs()).cwiseMax(origin.cwiseAbs());
}

/// By 45 degrees about the last axis.
Matrix3d turned(const Matrix3d& axes) {
  Matrix3d result = axes;
  result.col(0) = std::sqrt(0.5) * (axes.col(0) + axes.col(1));
  result.col(1) = std::sqrt(0.5) * (axes.col(1) - axes.col(0));
  return result;
}

/// Lemma: p - origin rounds by half an epsilon of the coordinates, whose 1-norms are at most `far`
/// for both, and the projections by at most three more of that size; likewise that of the centre.
/// kTurnedBoxRounding of `far` covers them.
OrientedBox along(const Matrix3d& wanted, const BallsInBox& balls, const Vector3d& origin,
                  double far) {
  const Matrix3d axes = wanted.unaryExpr(&inSinglePrecision);
  const Vector3d& first = balls.points.front();
  const Extents extents = extentsAlong(balls.points, axes);
  const Vector3d start = axes.transpose() * (first - origin);
  const Vector3d lower = start + extents.lower, upper = start + extents.upper;
  const Vector3d center = (axes * (0.5 * (lower + upper))).unaryExpr(&inSinglePrecision);
  const Vector3d middle = axes.transpose() * center;
  const double slack = kTurnedBoxRounding * far + balls.radius;
  OrientedBox box;
  box.center = origin + center;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) box.axes[j][i] = static_cast<float>(axes(i, j));
    box.half[j] = aboveInSingle(std::max(upper[j] - middle[j], middle[j] - lower[j]) + slack);
  }
  return box;
}

}  // namespace

OrientedBox fitOrientedBox(const BallsInBox& balls, const Matrix3d& scatter,
                           const Vector3d& origin) {
  const std::span<const Vector3d> points = balls.points;
  const Vector3d far = farthest(balls.bounds, origin);
  if (!(far.maxCoeff() < kLargest)) return unbounded(origin);
  Matrix3d axes = Matrix3d::Identity();
  if (points.size() == 3) {
    axes = triangleAxes(points[0], points[1], points[2]);
  } else if (points.size() > 3) {
    axes = principalAxes(scatter);
  }
  OrientedBox box = along(axes, balls, origin, far.sum());
  // Principal axes of a patch about as wide as it is long may be those of its diagonals.
  if (points.size() > 3 && box.half[1] > 0.6F * box.half[0]) {
    const OrientedBox diagonal = along(turned(axes), balls, origin, far.sum());
    if (halfSurfaceOf(diagonal) < halfSurfaceOf(box)) box = diagonal;
  }
  if (halfSurfaceOf(box) > halfSurface(balls.bounds.upper - balls.bounds.lower)) {
    box = along(Matrix3d::Identity(), balls, origin, far.sum());
  }
  return box;
}

OrientedBox fitBoxAlong(const BallsInBox& balls, const Matrix3d& axes, const Vector3d& origin) {
  const Vector3d far = farthest(balls.bounds, origin);
  if (!(far.maxCoeff() < kLargest)) return unbounded(origin);
  const OrientedBox box = along(axes, balls, origin, far.sum());
  return halfSurfaceOf(box) > halfSurface(balls.bounds.upper - balls.bounds.lower)
             ? alignedBox(balls.bounds, origin)
             : box;
}

OrientedBox alignedBox(const Aabb& bounds, const Vector3d& origin) {
  const Vector3d far = farthest(bounds, origin);
  if (!(far.maxCoeff() < kLargest)) return unbounded(origin);
  const Vector3d lower = bounds.lower - origin, upper = bounds.upper - origin;
  const Vector3d center = (0.5 * (lower + upper)).unaryExpr(&inSinglePrecision);
  OrientedBox box;
  box.center = origin + center;
  for (int i = 0; i < 3; ++i) {
    // The differences from the origin, and those from the centre, round once each.
    const double slack = kStraightBoxRounding * far[i];
    box.half[i] = aboveInSingle(std::max(upper[i] - center[i], center[i] - lower[i]) + slack);
  }
  return box;
}

Aabb withBalls(const Aabb& box, double radius) {
  // More than the one rounding of the coordinates.
  const Vector3d far = box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).array() + radius;
  const Vector3d growth = Vector3d::Constant(radius) + 4e-16 * far;
  return {box.lower - growth, box.upper + growth};
}

}  // namespace swept::detail
