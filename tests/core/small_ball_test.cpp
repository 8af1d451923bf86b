// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/small_ball.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh_samples.hpp"
#include "swept/core/convex_hull.hpp"
#include "swept/core/shapes.hpp"

/// The ball around points, against a bound below which no ball contains them.
namespace swept::test {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

/// m. No ball with a smaller radius contains all points: for weights w >= 0 that add up to 1, some
/// point is as far from any c as the root of sum w |p|^2 - |sum w p|^2 at least. Weight goes to the
/// point farthest from sum w p, step by step (Frank and Wolfe).
double leastRadius(const Points& points) {
  Vector3d mean = points.front();
  double squares = 0.0, best = 0.0;  // m^2, relative to the first point
  for (int step = 1; step <= 20'000; ++step) {
    const auto* farthest = &points.front();
    for (const Vector3d& point : points)
      if ((point - mean).squaredNorm() > (*farthest - mean).squaredNorm()) farthest = &point;
    const double share = 1.0 / (step + 1);
    squares += share * ((*farthest - points.front()).squaredNorm() - squares);
    mean += share * (*farthest - mean);
    best = std::max(best, squares - (mean - points.front()).squaredNorm());
  }
  return std::sqrt(best);
}

void expectAround(const Points& points, const BoundingSphere& ball) {
  for (const Vector3d& point : points) {
    const Vector3d offset = point - ball.center;
    ASSERT_LE(std::hypot(offset.x(), offset.y(), offset.z()), ball.radius);
  }
}

enum class Lie : std::uint8_t { InBall, OnSphere, OnCap, InBox, OnCorners, InPlane, OnLine };

Points draw(Lie lie, int count, std::mt19937& random) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const Vector3d unit = unitVector(random);
    Vector3d point = uniformPoint(random, 1.0);
    switch (lie) {
      case Lie::InBall:
        point = unit * std::cbrt(uniform(random, 0.0, 1.0));
        break;
      case Lie::OnSphere:
        point = unit;
        break;
      case Lie::OnCap:
        point = (unit + Vector3d(0.0, 0.0, 3.0)).normalized();
        break;
      case Lie::InBox:
        break;
      case Lie::OnCorners:
        point = point.cwiseSign();
        break;
      case Lie::InPlane:
        point.z() = 0.0;
        break;
      case Lie::OnLine:
        point.y() = point.z() = 0.0;
        break;
    }
    points.push_back(point);
  }
  return points;
}

TEST(SmallBall, IsTheSmallest) {
  std::mt19937 random(1);
  for (const Lie lie : {Lie::InBall, Lie::OnSphere, Lie::OnCap, Lie::InBox, Lie::OnCorners,
                        Lie::InPlane, Lie::OnLine}) {
    for (const int count : {1, 2, 3, 4, 5, 8, 40, 300}) {
      for (const double size : {1.0, 1e-100, 1e100}) {
        SCOPED_TRACE(testing::Message() << static_cast<int>(lie) << ' ' << count << ' ' << size);
        const Eigen::Isometry3d pose = randomPose(random, 2.0);
        // Needles and plates too.
        const Vector3d widths(1.0, std::pow(10.0, uniform(random, -6.0, 0.0)),
                              std::pow(10.0, uniform(random, -6.0, 0.0)));
        Points points, unit;
        for (const Vector3d& point : draw(lie, count, random)) {
          unit.push_back(pose * Vector3d(widths.cwiseProduct(point)));
          points.push_back(size * unit.back());
        }
        const BoundingSphere ball = detail::smallBall(points);
        expectAround(points, ball);
        EXPECT_LE(ball.radius, size * (leastRadius(unit) * (1.0 + 2e-4) + 1e-12));
      }
    }
  }
}

/// Points that are there several times, and that rounding alone keeps apart.
TEST(SmallBall, TakesPointsThatAreNearlyTheSame) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 300; ++trial) {
    Points points = draw(Lie::InBall, 3, random);
    const auto kinds = points.size();
    for (int i = 0; i < 20; ++i) {
      const double apart = trial % 2 == 0 ? 0.0 : 1e-15;
      points.push_back(points[random() % kinds] + apart * unitVector(random));
    }
    const BoundingSphere ball = detail::smallBall(points);
    expectAround(points, ball);
    EXPECT_LE(ball.radius, leastRadius(points) * (1.0 + 2e-4));
  }
}

/// Where squares are no numbers it is the ball about the middle of their box.
TEST(SmallBall, ContainsPointsOfAnySize) {
  std::mt19937 random(3);
  for (const double size : {1e-320, 1e-300, 1e-170, 1e160, 1e300, 8e307}) {
    Points points;
    for (const Vector3d& point : draw(Lie::InBox, 30, random)) points.push_back(size * point);
    const BoundingSphere ball = detail::smallBall(points);
    SCOPED_TRACE(size);
    EXPECT_TRUE(std::isfinite(ball.radius));
    expectAround(points, ball);
    EXPECT_LE(ball.radius, 1.7321 * size + 1e-307);
  }
}

TEST(SmallBall, OfAHullContainsWhatWasDropped) {
  std::mt19937 random(4);
  const Points points = draw(Lie::OnSphere, 2000, random);
  const ConvexHull hull = ConvexHull::of(points);
  expectAround(hull.vertices(), hull.ball());
  const ConvexHull few = ConvexHull::coarser(hull);
  ASSERT_GT(few.error(), 1e-3);
  expectAround(few.vertices(), few.ball());
  expectAround(points, boundingSphere(few));
  const ConvexHull large = ConvexHull::scaled(few, 3.0, Vector3d(1.0, 2.0, 3.0));
  for (const Vector3d& point : points) {
    const Vector3d moved = Vector3d(1.0, 2.0, 3.0) + 3.0 * (point - Vector3d(1.0, 2.0, 3.0));
    EXPECT_LE((moved - boundingSphere(large).center).norm(),
              boundingSphere(large).radius * (1.0 + 1e-14));
  }
}

}  // namespace
}  // namespace swept::test
