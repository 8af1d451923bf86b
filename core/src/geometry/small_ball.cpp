// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/small_ball.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "swept/core/bv/aabb.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;
using Points = std::span<const Vector3d>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Relative, of squares. A point this near to the boundary of the smallest ball counts as on it.
constexpr double kEnough = 1e-9;
/// Cap on the pivots. Each pivot but the last grows the ball, so they end; how soon is not proven.
constexpr int kMaxPivots = 64;

struct Ball {
  Vector3d center;
  double squared;  ///< of its radius
};

struct Farthest {
  Vector3d point = Vector3d::Zero();
  double squared = -1.0;  ///< of its distance
};

Farthest farthest(Points points, const Vector3d& from) {
  Farthest found;
  for (const Vector3d& point : points) {
    const double squared = (point - from).squaredNorm();
    if (squared > found.squared) found = {point, squared};
  }
  return found;
}

/// Up to four points, on the boundary of a ball.
struct Support {
  std::array<Vector3d, 4> points;
  std::size_t count = 0;

  void add(const Vector3d& point) { points[count++] = point; }
  /// Keeps those whose bits are set.
  void keep(unsigned subset) {
    const std::size_t held = std::exchange(count, 0);
    for (std::size_t i = 0; i < held; ++i)
      if ((subset >> i & 1U) != 0) add(points[i]);
  }
  Points all() const { return {points.data(), count}; }
};

/// The ball through `first` and all of up to three others, with its centre in the plane, line or
/// point that they span; NaN if they do not determine one.
Ball through(const Vector3d& first, Points others) {
  using Edges = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 3>;
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3, 3>;
  if (others.empty()) return {first, 0.0};
  Edges edges(3, static_cast<Eigen::Index>(others.size()));
  for (Eigen::Index i = 0; i < edges.cols(); ++i)
    edges.col(i) = others[static_cast<std::size_t>(i)] - first;
  // As far from the end of each edge as from its start.
  const Square products = edges.transpose() * edges;
  const Vector3d offset = edges * products.ldlt().solve(0.5 * products.diagonal());
  return {first + offset, offset.squaredNorm()};
}

/// A ball that grows, and the points that support it.
class GrowingBall {
 public:
  const Vector3d& center() const { return ball_.center; }
  bool contains(double squaredDistance) const { return isWithin(squaredDistance, ball_); }

  /// The smallest ball that contains `point`, which lies outside, and the present support. False if
  /// rounding hides which ball that is.
  bool growTo(const Vector3d& point) {
    Ball least{Vector3d::Zero(), kInfinity};
    unsigned kept = 0;
    for (unsigned subset = 0; subset < (1U << support_.count); ++subset) {
      if (std::popcount(subset) > 3) continue;
      Support others;
      for (std::size_t i = 0; i < support_.count; ++i)
        if ((subset >> i & 1U) != 0) others.add(support_.points[i]);
      const Ball ball = through(point, others.all());
      const bool holds = std::ranges::all_of(support_.all(), [&](const Vector3d& held) {
        return isWithin((held - ball.center).squaredNorm(), ball);
      });
      if (!holds || !(ball.squared < least.squared)) continue;
      least = ball;
      kept = subset;
    }
    if (!(least.squared > ball_.squared && least.squared < kInfinity)) return false;
    ball_ = least;
    support_.keep(kept);
    support_.add(point);
    return true;
  }

 private:
  static bool isWithin(double squaredDistance, const Ball& ball) {
    return squaredDistance <= ball.squared * (1.0 + kEnough);
  }

  Support support_;
  Ball ball_{Vector3d::Zero(), -1.0};
};

}  // namespace

BoundingSphere ballAround(const Vector3d& center, Points points) {
  double radius = 0.0;
  for (const Vector3d& point : points) {
    const Vector3d offset = point - center;
    radius = std::max(radius, std::hypot(offset.x(), offset.y(), offset.z()));
  }
  return {center, aboveRounding(radius)};
}

BoundingSphere smallBall(Points points) {
  // If points are symmetric, the middle of the box is already the centre.
  const Aabb box = Aabb::fit(points);
  const Vector3d center = 0.5 * box.lower + 0.5 * box.upper;
  Farthest outermost = farthest(points, center);
  Vector3d best = center;
  double least = outermost.squared;
  GrowingBall ball;
  for (int i = 0; i < kMaxPivots && ball.growTo(outermost.point); ++i) {
    outermost = farthest(points, ball.center());
    if (outermost.squared < least) {
      least = outermost.squared;
      best = ball.center();
    }
    if (ball.contains(outermost.squared)) break;
  }
  return ballAround(best, points);
}

}  // namespace swept::detail
