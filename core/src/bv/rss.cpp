// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/bv/rss.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bv/box_pair.hpp"
#include "bv/extents.hpp"
#include "bv/principal_axes.hpp"
#include "bv/rectangle_pair.hpp"
#include "swept/core/bv/bounding_volume.hpp"
#include "swept/core/bv/obb.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

static_assert(BoundingVolume<Rss>);

namespace {

using detail::RectanglePair;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Rss unboundedRectangle() {
  return {Matrix3d::Identity(), Vector3d::Constant(NAN), Vector2d::Constant(NAN), NAN};
}

/// A point with a ball around it, in the axes of the volume, from its first point.
struct Ball {
  Vector3d at;    ///< m
  double radius;  ///< m
};

/// Rectangle in the plane of the first two axes. Empty at first: its ends are before its starts.
struct Rectangle {
  Vector2d lower = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d upper = Vector2d::Constant(-std::numeric_limits<double>::infinity());
  double radius = 0.0;  ///< m
  double height = 0.0;  ///< m, along the third axis

  /// m; how far the rectangle may end before the foot point of the ball.
  double reach(const Ball& ball) const {
    const double room = radius - ball.radius;
    const double z = ball.at.z() - height;
    return std::sqrt(std::max(0.0, room * room - z * z));
  }
  /// Moves the edges out until they reach the balls beyond them.
  void reachAlong(const Ball& ball) {
    const Vector3d& p = ball.at;
    if (p[0] >= lower[0] && p[0] <= upper[0] && p[1] >= lower[1] && p[1] <= upper[1]) return;
    const double near = reach(ball);
    for (int k = 0; k < 2; ++k) {
      lower[k] = std::min(lower[k], p[k] + near);
      upper[k] = std::max(upper[k], p[k] - near);
    }
  }
  /// If all balls are reached from anywhere between two edges, puts both edges in the middle.
  void close() {
    for (int k = 0; k < 2; ++k) {
      if (lower[k] > upper[k]) lower[k] = upper[k] = 0.5 * (lower[k] + upper[k]);
    }
  }
  /// Moves the nearest corner out until it reaches a ball beyond it.
  void reachPastCorner(const Ball& ball) {
    Vector2d beyond;  // signed
    for (int k = 0; k < 2; ++k) {
      beyond[k] = std::max(0.0, ball.at[k] - upper[k]) - std::max(0.0, lower[k] - ball.at[k]);
    }
    if (beyond[0] == 0.0 || beyond[1] == 0.0) return;
    const double squared = beyond.squaredNorm();
    const double near = reach(ball);
    if (squared <= near * near) return;
    const Vector2d step = (1.0 - near / std::sqrt(squared)) * beyond;
    for (int k = 0; k < 2; ++k) (step[k] > 0.0 ? upper : lower)[k] += step[k];
  }
};

struct Extent {
  double lower = std::numeric_limits<double>::infinity();
  double upper = -std::numeric_limits<double>::infinity();

  void include(double x) {
    lower = std::min(lower, x);
    upper = std::max(upper, x);
  }
};

/// The slab, across the plane of the rectangle, that holds all balls; from the first point.
struct Slab {
  double radius;  ///< m, half its thickness
  double height;  ///< m, of its middle
};

/// The rectangle in the middle of the slab that ends as early as it can (Larsen et al. 2000,
/// section 4). `ballAt(i)` for i < count; no ball is farther than `reach` from `origin`.
///
/// Lemma (containment): the coordinates round by a few epsilons of the largest difference or of the
/// middle's coordinates, the squared reach by a few epsilons of the squared radius, hence the
/// distance to the rectangle by as few of the radius. The growth below exceeds their sum and that
/// of contains(). Its last term exceeds what is off where squares of small numbers underflow: the
/// root of the least denormal, a few times.
template <typename BallAt>
Rss fitBalls(std::size_t count, const BallAt& ballAt, const Slab& slab, const Matrix3d& axes,
             const Vector3d& origin, double reach) {
  Rectangle rectangle;
  rectangle.radius = slab.radius;
  rectangle.height = slab.height;
  for (std::size_t i = 0; i < count; ++i) rectangle.reachAlong(ballAt(i));
  rectangle.close();
  for (std::size_t i = 0; i < count; ++i) rectangle.reachPastCorner(ballAt(i));

  const Vector2d middle = 0.5 * (rectangle.lower + rectangle.upper);
  const double growth = 1e-14 * reach + 2e-15 * detail::magnitude(origin) + 1e-150;
  return {axes, origin + axes * Vector3d(middle.x(), middle.y(), rectangle.height),
          0.5 * (rectangle.upper - rectangle.lower), rectangle.radius + growth};
}

/// The four corners of each rectangle.
std::array<Vector3d, 8> cornersOf(const Rss& a, const Rss& b) {
  std::array<Vector3d, 8> corners;
  for (int i = 0; i < 4; ++i) {
    const double x = i & 1 ? 1.0 : -1.0;
    const double y = i & 2 ? 1.0 : -1.0;
    for (const auto& [rss, offset] : {std::pair(&a, 0), std::pair(&b, 4)}) {
      corners[i + offset] = rss->middle + x * rss->halfLengths.x() * rss->axes.col(0) +
                            y * rss->halfLengths.y() * rss->axes.col(1);
    }
  }
  return corners;
}

RectanglePair pairOf(const Rss& a, const Rss& b, const Vector3d& firstAxis,
                     const Vector3d& secondAxis, const Vector3d& offset, double magnitudeOfPose) {
  RectanglePair p;
  p.offset.noalias() = a.axes.transpose() * offset;
  p.firstAxis.noalias() = a.axes.transpose() * firstAxis;
  p.secondAxis.noalias() = a.axes.transpose() * secondAxis;
  p.halfA = a.halfLengths;
  p.halfB = b.halfLengths;
  p.radii = a.radius + b.radius;
  p.margin = detail::volumeMargin(magnitudeOfPose + detail::magnitude(a.middle) +
                                  detail::magnitude(b.middle) + a.halfLengths.sum() +
                                  b.halfLengths.sum() + p.radii);
  return p;
}

RectanglePair pairOf(const Rss& a, const Rss& b) {
  return pairOf(a, b, b.axes.col(0), b.axes.col(1), b.middle - a.middle, 0.0);
}

RectanglePair pairOf(const Rss& a, const Rss& b, const Isometry3d& a_from_b) {
  const Matrix3d rotation = a_from_b.linear();
  const Vector3d offset = rotation * b.middle + a_from_b.translation() - a.middle;
  return pairOf(a, b, rotation * b.axes.col(0), rotation * b.axes.col(1), offset,
                detail::magnitude(a_from_b.translation()));
}

}  // namespace

Rss Rss::fit(std::span<const Vector3d> points) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, points] { return fit(points); });
  }
  return fitWithin(points, Obb::fit(points));
}

Rss Rss::fitWithin(std::span<const Vector3d> points, const Obb& box) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, points] { return fitWithin(points, box); });
  }
  if (points.empty() || !box.halfExtents.allFinite()) return unboundedRectangle();
  const Matrix3d& axes = box.axes;
  const auto ballAt = [&](std::size_t i) {
    const Vector3d d = points[i] - box.middle;
    return Ball{{axes(0, 0) * d[0] + axes(1, 0) * d[1] + axes(2, 0) * d[2],
                 axes(0, 1) * d[0] + axes(1, 1) * d[1] + axes(2, 1) * d[2],
                 axes(0, 2) * d[0] + axes(1, 2) * d[1] + axes(2, 2) * d[2]},
                0.0};
  };
  return fitBalls(points.size(), ballAt, {box.halfExtents.z(), 0.0}, axes, box.middle,
                  detail::magnitude(box.halfExtents));
}

Rss Rss::merge(const Rss& a, const Rss& b) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return merge(a, b); });
  }
  if (!(a.halfLengths + b.halfLengths).allFinite()) return unboundedRectangle();
  const std::array<Vector3d, 8> corners = cornersOf(a, b);
  const Vector3d origin = corners.front();
  Rss best = unboundedRectangle();
  const auto consider = [&](const Matrix3d& frame) {
    const auto ballAt = [&](std::size_t i) {
      return Ball{frame.transpose() * (corners[i] - origin), i < 4 ? a.radius : b.radius};
    };
    Extent across;
    double reach = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Ball ball = ballAt(i);
      across.include(ball.at.z() - ball.radius);
      across.include(ball.at.z() + ball.radius);
      reach = std::max(reach, detail::magnitude(ball.at) + ball.radius);
    }
    const Slab slab{0.5 * (across.upper - across.lower), 0.5 * (across.upper + across.lower)};
    const Rss merged = fitBalls(corners.size(), ballAt, slab, frame, origin, reach);
    if (!(merged.size() >= best.size())) best = merged;
  };
  consider(a.axes);
  consider(b.axes);
  Matrix3d axes = detail::principalAxes(detail::scatterOf(corners));
  detail::Extents extents = detail::extentsAlong(corners, axes);
  detail::sortLongestFirst(axes, extents);
  consider(axes);
  // The corners carry the rounding of their coordinates.
  best.radius += detail::kVolumeRounding *
                 (detail::magnitude(a.middle) + detail::magnitude(b.middle) + best.radius);
  return best;
}

Rss Rss::inflated(double by) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, by] { return inflated(by); });
  }
  return {axes, middle, halfLengths, radius + by + 4e-16 * (by + radius)};
}

bool Rss::overlaps(const Rss& other) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return overlaps(other); });
  }
  return !detail::separated(pairOf(*this, other));
}

bool Rss::overlaps(const Rss& other, const Isometry3d& a_from_b) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return overlaps(other, a_from_b); });
  }
  return !detail::separated(pairOf(*this, other, a_from_b));
}

double Rss::distanceBound(const Rss& other, const Isometry3d& a_from_b) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return distanceBound(other, a_from_b); });
  }
  return detail::gapBound(pairOf(*this, other, a_from_b));
}

bool Rss::contains(const Vector3d& p) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return contains(p); });
  }
  const Vector3d local = axes.transpose() * (p - middle);
  double squared = local.z() * local.z();
  for (int k = 0; k < 2; ++k) {
    const double beyond = std::max(0.0, std::abs(local[k]) - halfLengths[k]);
    squared += beyond * beyond;
  }
  return !(squared > radius * radius);
}

}  // namespace swept
