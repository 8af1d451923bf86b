// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/scene_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "swept/robot_model/usage_error.hpp"

namespace {

using namespace swept;
using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

Isometry3d poseAt(const Vector3d& place, double angle) {
  return Translation3d(place) * AngleAxisd(angle, Vector3d(1, 2, 3).normalized());
}

/// A crate and a tetrahedron in one body, a ball, a can that moves, and a body without geometry.
World sceneOf() {
  World world;
  WorldBody stand{.name = "stand \"a\": 1", .parts = {}};
  stand.parts.push_back({makeBox({0.5, 0.1, 0.2}), poseAt({1, 2, 3}, 0.7)});
  const std::vector<Vector3d> corners{{0, 0, 0}, {0.4, 0, 0}, {0, 0.3, 0}, {0.1, 0.1, 0.5}};
  const std::vector<Eigen::Vector3i> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  stand.parts.push_back({TriangleMesh::build(corners, faces), poseAt({1.1, 2.1, 3.0}, -1.1)});
  world.add(std::move(stand));
  world.add("ball", makeSphere(0.2), poseAt({0, 0, 1}, 0.3));
  world.add(WorldBody{.name = "ghost", .parts = {}});
  MovingObstacle can{.name = "can", .parts = {}, .waypoints = {}};
  can.parts.push_back({makeCylinder(0.05, 0.3), poseAt({0, 0, 0.15}, 0.2)});
  can.waypoints.push_back({0.0, poseAt({5, 0, 0}, 0.0)});
  can.waypoints.push_back({2.5, poseAt({6, 1, 0}, 1.3)});
  world.add(std::move(can));
  return world;
}

class SceneModels : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("scenes_") + info->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  std::filesystem::path folder_;
  World world_ = sceneOf();
  std::vector<NamedBody> bodies_ = bodiesOf(world_);
};

TEST_F(SceneModels, AreOfTheBodiesWithGeometry) {
  ASSERT_EQ(bodies_.size(), 3u);
  EXPECT_EQ(bodies_[0].name, "stand \"a\": 1");
  EXPECT_EQ(bodies_[0].shapes.size(), 2u);
  EXPECT_EQ(bodies_[1].name, "ball");
  EXPECT_TRUE(bodies_[1].shapes[0].body_from_shape.translation().isApprox(Vector3d(0, 0, 1)));
  // In its own frame, wherever it is.
  EXPECT_EQ(bodies_[2].name, "can");
  EXPECT_LT(bodies_[2].shapes[0].body_from_shape.translation().norm(), 0.2);
}

/// Corners of the crate and the tetrahedron, and points of the ball and the can, by hand.
std::vector<Vector3d> pointsOf(const std::string& name, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto share = [&] { return 0.5 * (unit(random) + 1.0); };
  std::vector<Vector3d> points;
  for (int i = 0; i < 4000; ++i) {
    if (name == "ball") {
      const Vector3d p(unit(random), unit(random), unit(random));
      points.push_back(Vector3d(0, 0, 1) + 0.2 * p.normalized());
    } else if (name == "can") {
      const double angle = std::numbers::pi * unit(random);
      points.push_back(poseAt({0, 0, 0.15}, 0.2) * Vector3d(0.05 * std::cos(angle),
                                                            0.05 * std::sin(angle),
                                                            0.15 * unit(random)));
    } else if (i % 2 == 0) {
      points.push_back(poseAt({1, 2, 3}, 0.7) *
                       Vector3d(0.25 * unit(random), 0.05 * unit(random), 0.1 * unit(random)));
    } else {
      double a = share(), b = share(), c = share();
      const double sum = std::max(1.0, a + b + c);
      points.push_back(poseAt({1.1, 2.1, 3.0}, -1.1) *
                       (a / sum * Vector3d(0.4, 0, 0) + b / sum * Vector3d(0, 0.3, 0) +
                        c / sum * Vector3d(0.1, 0.1, 0.5)));
    }
  }
  return points;
}

bool isIn(const Vector3d& point, const EnclosingSphere& sphere) {
  return (point - sphere.center).norm() <= sphere.radius;
}

TEST_F(SceneModels, AreNotRefuted) {
  std::mt19937 random(5);
  SphereModelOptions options;
  options.spheres = 12;
  options.search = {.pieces = 400, .restarts = 1, .rounds = 5};
  const SphereModel model = enclosingSphereModel(bodies_, options);
  EXPECT_LE(model.count(), 12u);
  for (const LinkSpheres& body : model.links) {
    int onlyInOne = 0;
    for (const Vector3d& point : pointsOf(body.link, random)) {
      const auto in = std::ranges::count_if(
          body.spheres, [&](const EnclosingSphere& sphere) { return isIn(point, sphere); });
      EXPECT_GE(in, 1) << body.link << point.transpose();
      onlyInOne += in == 1 ? 1 : 0;
    }
    EXPECT_GT(onlyInOne, 0) << body.link;
  }
  for (const LinkSphereReport& report : judgeSphereModel(bodies_, model))
    EXPECT_LE(report.outside.upper, 0.0) << report.link;
}

TEST_F(SceneModels, AreTheSameWhenReadAgain) {
  for (const EnclosingKind kind :
       {EnclosingKind::Capsule, EnclosingKind::Box, EnclosingKind::Convex}) {
    const ShapeModel model =
        enclosingShapeModel(bodies_, {.kind = kind, .shapes = 7, .excess = {}, .search = {60}});
    for (const auto& file : {write("a.json", sceneModelJson(model, "room", {})),
                             write("a.yaml", sceneModelYaml(model, world_, "room"))}) {
      const ShapeModel again = readSceneModel(file, world_);
      EXPECT_EQ(again.count(), model.count()) << file;
      for (const LinkSphereReport& report : judgeShapeModel(bodies_, again))
        EXPECT_LE(report.outside.upper, 0.0) << file << report.link;
    }
  }
  SphereModelOptions options;
  options.spheres = 8;
  options.search = {.pieces = 300, .restarts = 1, .rounds = 3};
  const SphereModel spheres = enclosingSphereModel(bodies_, options);
  const ShapeModel model = shapeModelOf(spheres);
  for (const auto& file : {write("s.json", sceneModelJson(model, "room", {})),
                           write("s.yaml", sceneModelYaml(model, world_, "room"))}) {
    const std::optional<SphereModel> again = sphereModelOf(readSceneModel(file, world_));
    ASSERT_TRUE(again.has_value()) << file;
    EXPECT_EQ(curoboSpheres(*again, "r"), curoboSpheres(spheres, "r")) << file;
  }
}

/// In MoveIt's text nothing moves, and names end with their line.
TEST_F(SceneModels, AreTheSameInMoveItsText) {
  world_.remove("can");
  bodies_ = bodiesOf(world_);
  ShapeModel model = enclosingShapeModel(
      bodies_, {.kind = EnclosingKind::Capsule, .shapes = 5, .excess = {}, .search = {60}});
  const auto file = write("a.scene", sceneModelText(model, world_, "two\nlines"));
  const ShapeModel again = readSceneModel(file, world_);
  EXPECT_EQ(again.count(), model.count());
  for (const LinkSphereReport& report : judgeShapeModel(bodies_, again))
    EXPECT_LE(report.outside.upper, 0.0) << report.link;
  for (const std::string name : {"", "a\nb", " a", "a\t"}) {
    model.links[0].link = name;
    EXPECT_THROW(sceneModelText(model, world_, "room"), UsageError) << name;
  }
}

TEST_F(SceneModels, RefuseWhatMakesNoSense) {
  SphereModelOptions options;
  options.spheres = 8;
  EXPECT_THROW(sceneModelText(shapeModelOf(enclosingSphereModel(bodies_, options)), world_, "room"),
               UsageError);
  options.spheres = 2;
  EXPECT_THROW(enclosingSphereModel(bodies_, options), UsageError);
  options.spheres = 8;
  bodies_.push_back({"ball", {{makeSphere(0.1), Isometry3d::Identity()}}});
  EXPECT_THROW(enclosingSphereModel(bodies_, options), std::invalid_argument);
  bodies_.back() = {"nothing", {}};
  EXPECT_THROW(enclosingSphereModel(bodies_, options), std::invalid_argument);
  bodies_.back() = {"floor", {{makePlane({0, 0, 1}, 0.0), Isometry3d::Identity()}}};
  EXPECT_THROW(enclosingSphereModel(bodies_, options), UsageError);
  EXPECT_THROW(judgeSphereModel(bodies_, {}), UsageError);
  ShapeModel cone;
  cone.links.push_back({"ball", {{makeCone(0.1, 0.2), Isometry3d::Identity()}}});
  EXPECT_THROW(sceneModelYaml(cone, world_, "room"), std::invalid_argument);
  EXPECT_THROW(sceneModelJson(cone, "room", {}), std::invalid_argument);
}

}  // namespace
