// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/sensed_world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "swept/core/distance.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Cubes of 1, 2 and 4 times the resolution, on their grids, that do not overlap.
OccupancyMap randomMap(std::mt19937& random, int cubes) {
  OccupancyMap map{.resolution = 0.05, .occupied = {}};
  for (int i = 0; i < cubes; ++i) {
    const int size = 1 << (random() % 3);
    const double side = size * map.resolution;
    const auto cell = [&] { return static_cast<int>(random() % 8) - 4; };
    // Each in an own block of eight cells along x.
    const Vector3d corner(8 * i * map.resolution, cell() * side, cell() * side);
    map.occupied.push_back({corner + Vector3d::Constant(0.5 * side), side});
  }
  return map;
}

double distanceFrom(const WorldBody& body, const Vector3d& p) {
  const Isometry3d at(Eigen::Translation3d{p});
  double least = std::numeric_limits<double>::infinity();
  for (const WorldBody::Part& part : body.parts) {
    const Isometry3d shape_from_ball = part.world_from_shape.inverse() * at;
    least = std::min(least, distance(part.shape, makeSphere(0.0), shape_from_ball).lower);
  }
  return least;
}

TEST(OccupiedBody, ContainsTheCubesAndReachesLittleBeyondThem) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(-0.5, 0.5);
  const OccupancyMap map = randomMap(random, 60);
  const Isometry3d pose =
      Eigen::Translation3d(0.3, -0.2, 0.1) * Eigen::Quaterniond(0.9, 0.1, 0.2, 0.3).normalized();
  const WorldBody body = occupiedBody("map", map, pose);
  EXPECT_EQ(body.name, "map");
  int far = 0;
  for (const OccupancyMap::Cube& cube : map.occupied) {
    for (int i = 0; i < 30; ++i) {
      const Vector3d inside = cube.side * Vector3d(share(random), share(random), share(random));
      EXPECT_EQ(distanceFrom(body, pose * (cube.center + inside)), 0.0);
    }
    for (int i = 0; i < 8; ++i) {
      const Vector3d corner =
          0.5 * cube.side * Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
      EXPECT_LE(distanceFrom(body, pose * (cube.center + corner)), 1e-12);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d beyond = (0.5 * cube.side + 0.4 * map.resolution) * Vector3d::Unit(axis);
      far += distanceFrom(body, pose * (cube.center + beyond)) > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(far, 150) << "of 180; neighbours are in the way of some";
}

TEST(OccupiedBody, BallsAreForTheSmallestCubes) {
  const OccupancyMap map{.resolution = 0.1,
                         .occupied = {{Vector3d(0.05, 0.05, 0.05), 0.1},
                                      {Vector3d(1.0, 1.0, 1.0), 0.4},
                                      {Vector3d(0.15, 0.05, 0.05), 0.1}}};
  const WorldBody body = occupiedBody("map", map, Isometry3d::Identity());
  ASSERT_EQ(body.parts.size(), 2u);
  EXPECT_EQ(std::get<Box>(body.parts[0].shape).halfExtents, Vector3d::Constant(0.2));
  const auto& cloud = std::get<PointCloud>(body.parts[1].shape);
  EXPECT_EQ(cloud.points().size(), 2u);
  EXPECT_NEAR(cloud.largestRadius(), 0.1 * std::sqrt(0.75), 1e-12);
  EXPECT_TRUE(occupiedBody("map", {.resolution = 0.1, .occupied = {}}, Isometry3d::Identity())
                  .parts.empty());
}

}  // namespace
}  // namespace swept
