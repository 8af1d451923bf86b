// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <random>

#include "../core/cover_samples.hpp"
#include "data_folder.hpp"
#include "input_files.hpp"
#include "models_dir.hpp"
#include "swept/core/sphere_cover.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;

int trianglesOf(const Shape& shape) {
  const auto* mesh = std::get_if<TriangleMesh>(&shape);
  return mesh == nullptr ? 1 : static_cast<int>(mesh->triangles().size());
}

/// Samples of the link's geometry are in the balls of a path to a leaf, those of balls one percent
/// smaller are not all; points on balls are no farther from the geometry than the overhang, those
/// on inner balls are in it.
void expectSound(const Shape& shape, const SphereCover& cover, std::mt19937& random) {
  // Each sample of a mesh looks at all its triangles.
  const int work = std::clamp(1'000'000 / trianglesOf(shape), 40, 1000);
  const BoundingSphere ball = boundingSphere(shape);
  const double slack = 1e-13 * (ball.center.norm() + ball.radius);
  int missedByShrunk = 0;
  for (const Vector3d& p : std::visit(test::SampleOf(random, work), shape)) {
    ASSERT_TRUE(test::covers(cover, p, slack)) << "point " << p.transpose();
    missedByShrunk += test::covers(cover, p, slack, 0.99) ? 0 : 1;
  }
  EXPECT_GT(missedByShrunk, 0);
  std::uniform_int_distribution<std::size_t> anyNode(0, cover.nodes.size() - 1);
  for (int i = 0; i < work / 4; ++i) {
    const SphereCover::Node& node = cover.nodes[anyNode(random)];
    const Vector3d p =
        node.ball.center.cast<double>() + double{node.ball.radius} * test::unitVector(random);
    ASSERT_LE(std::visit(test::DistanceOf{p}, shape), node.overhang + slack);
  }
  for (const CoverBall& inner : cover.inner) {
    const Vector3d p =
        inner.center.cast<double>() + double{inner.radius} * test::unitVector(random);
    ASSERT_LE(std::visit(test::DistanceOf{p}, shape), slack);
  }
}

/// Returns the balls of all links' finest levels.
int expectSoundRobot(const Robot& robot, double finest) {
  std::mt19937 random(1);
  SphereCoverOptions options;
  options.finestOverhang = finest;
  options.finestRelative = 0.0;
  int count = 0;
  for (const Link& link : robot.links()) {
    for (const CollisionGeometry& geometry : link.collision) {
      SCOPED_TRACE(robot.name() + ", " + link.name);
      const SphereCover cover = sphereCover(geometry.shape, options);
      expectSound(geometry.shape, cover, random);
      count += cover.levels.back().ballCount;
    }
  }
  return count;
}

TEST(LinkCover, ContainsTheLinksOfOurRobots) {
  const std::filesystem::path robots = std::filesystem::path(modelsDir()) / "robots";
  for (const char* name : {"drifter", "rook6", "rook6_cart", "rook7"}) {
    const auto robot = Robot::load(robots / name / (std::string(name) + ".urdf"));
    EXPECT_GT(expectSoundRobot(*robot, 0.02), 0);
  }
}

TEST(LinkCover, ContainsTheLinksOfOutsideRobots) {
  const auto data = dataFolder();
  if (!data) GTEST_SKIP() << "skipped: SWEPT_DATA is not set";
  const std::filesystem::path robots = *data / "robots";
  const int panda = expectSoundRobot(*Robot::load(robots / "panda/panda.urdf"), 0.02);
  // A set of balls made by hand has 59 and leaves parts of the links outside.
  EXPECT_LE(panda, 320);
  EXPECT_GT(expectSoundRobot(*Robot::load(robots / "ur5/ur5.urdf"), 0.02), 0);
  LoadOptions options;
  options.packages = {{"moveit_resources_pr2_description/urdf", robots / "pr2"}};
  EXPECT_GT(expectSoundRobot(*Robot::load(robots / "pr2/pr2.urdf", {}, options), 0.03), 0);
}

}  // namespace
}  // namespace swept
