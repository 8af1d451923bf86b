// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/sensed_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "mesh_samples.hpp"
#include "message_of.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> randomPoints(std::mt19937& random, int count, double most) {
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) points.push_back(test::uniformPoint(random, most));
  return points;
}

TEST(NeighborDistances, AreThoseOfBruteForce) {
  std::mt19937 random(1);
  for (const int count : {2, 9, 70, 700}) {
    std::vector<Vector3d> given = randomPoints(random, count, 1.0);
    given.push_back(given.front());  // a point twice
    const PointCloud cloud = PointCloud::build(given, 0.1);
    const auto& points = cloud.points();
    for (const int k : {1, 4, 10}) {
      const std::vector<double> found = neighborDistances(cloud, k);
      for (std::size_t i = 0; i < points.size(); ++i) {
        std::vector<double> all;
        for (std::size_t j = 0; j < points.size(); ++j) {
          if (j != i) all.push_back((points[j] - points[i]).norm());
        }
        std::ranges::sort(all);
        const auto place = static_cast<std::size_t>(k - 1);
        EXPECT_EQ(found[i],
                  place < all.size() ? all[place] : std::numeric_limits<double>::infinity());
      }
    }
  }
}

TEST(NeighborDistances, RefuseZero) {
  const PointCloud cloud = PointCloud::build(std::vector<Vector3d>(3, Vector3d::Zero()), 0.1);
  EXPECT_EQ(test::messageOf([&] { static_cast<void>(neighborDistances(cloud, 0)); }),
            "neighborDistances: k is 0; allowed: at least 1");
}

/// Whether the straight way from p to the sensor meets the ball, with p behind it.
bool hides(const Vector3d& center, double radius, const Vector3d& sensor, const Vector3d& p) {
  const Vector3d way = p - sensor;
  const double along = (center - sensor).dot(way) / way.squaredNorm();
  if (along <= 0.0 || along >= 1.0) return false;
  return (sensor + along * way - center).norm() <= radius && (p - center).norm() > radius;
}

TEST(OccludedBalls, ContainWhatIsHidden) {
  std::mt19937 random(2);
  constexpr double kRange = 3.0;
  int hidden = 0, seen = 0, seenInside = 0;
  for (const double radius : {0.3, 0.1, 0.01}) {
    const Vector3d sensor = test::uniformPoint(random, 0.5);
    for (int i = 0; i < 40; ++i) {
      const Vector3d point = sensor + test::uniformPoint(random, 1.5);
      const Balls balls = occludedBalls(std::vector<Vector3d>{point}, radius, sensor, kRange);
      const double d = (point - sensor).norm();
      EXPECT_EQ(balls.centers.empty(), d <= radius);
      for (int j = 0; j < 500; ++j) {
        const Vector3d target = point + 1.5 * radius * test::uniformPoint(random, 1.0);
        const double share = std::uniform_real_distribution<double>(1.0, kRange / d)(random);
        const Vector3d p = sensor + share * (target - sensor);
        if ((p - sensor).norm() > kRange) continue;
        bool inside = false;
        for (std::size_t k = 0; k < balls.centers.size(); ++k)
          inside |= (p - balls.centers[k]).norm() <= balls.radii[k];
        if (d > radius && hides(point, radius, sensor, p)) {
          EXPECT_TRUE(inside) << d << " " << radius;
          ++hidden;
        } else {
          ++seen;
          seenInside += inside ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(hidden, 5000);
  EXPECT_GT(seen, 5000);
  EXPECT_LT(seenInside, seen / 2) << "they reach a third beyond the shadow";
}

TEST(OccludedBalls, AreAsManyAsStated) {
  const std::vector<Vector3d> points{Vector3d(1.0, 0.0, 0.0)};
  const Balls balls = occludedBalls(points, 0.01, Vector3d::Zero(), 3.0);
  EXPECT_NEAR(static_cast<double>(balls.centers.size()), std::log(3.0) / 0.015, 2.0);
  EXPECT_TRUE(occludedBalls(points, 0.01, Vector3d::Zero(), 0.9).centers.empty());
}

TEST(OccludedBalls, RefuseWhatIsNotFinite) {
  const std::vector<Vector3d> points{Vector3d(1.0, 0.0, 0.0), Vector3d(1.0, NAN, 0.0)};
  const auto message = [&](double radius, const Vector3d& sensor, double range) {
    return test::messageOf(
        [&] { static_cast<void>(occludedBalls(points, radius, sensor, range)); });
  };
  const Vector3d zero = Vector3d::Zero();
  EXPECT_EQ(message(0.0, zero, 1.0),
            "radius of the occluded space is 0; allowed: finite and above zero");
  EXPECT_EQ(message(0.1, zero, INFINITY),
            "range of the occluded space is inf; allowed: finite and above zero");
  EXPECT_EQ(message(0.1, Vector3d(0.0, INFINITY, 0.0), 2.0),
            "sensor of the occluded space is (0, inf, 0); allowed: finite coordinates");
  EXPECT_EQ(message(0.1, zero, 2.0),
            "point 1 of the occluded space is (1, nan, 0); allowed: finite coordinates");
}

}  // namespace
}  // namespace swept
