// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <memory>
#include <vector>

#include "models_dir.hpp"
#include "swept/core/broadphase/body_tree.hpp"
#include "swept/core/broadphase/sweep_and_prune.hpp"
#include "swept/core/bvh/bvh_model.hpp"
#include "swept/core/continuous/continuous_collide.hpp"
#include "swept/core/continuous/motions.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"
#include "swept/core/traversal/mesh_collision.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/robot_model/cloud_file.hpp"
#include "swept/robot_model/sensed_world.hpp"

/// What ompl_bridge/migration.md shows as swept's way, line by line, and what comes of it.
namespace swept::test {
namespace {

namespace og = ompl::geometric;

Eigen::Isometry3d at(double x, double y = 0.0, double z = 0.0) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

TEST(Migration, TwoShapes) {
  const Eigen::Isometry3d world_from_box = at(1.0), world_from_ball = at(1.3);

  const swept::Shape box = swept::makeBox({0.2, 0.2, 0.4});
  const swept::Shape ball = swept::makeSphere(0.1);
  const Eigen::Isometry3d box_from_ball = world_from_box.inverse() * world_from_ball;

  const bool mayTouch = swept::collide(box, ball, box_from_ball) != swept::Contact::Separate;
  const swept::SignedDistanceResult found = swept::signedDistance(box, ball, box_from_ball);
  const double clearance = found.lower;  // m, proven; found.upper is witnessed

  EXPECT_FALSE(mayTouch);
  EXPECT_NEAR(clearance, 0.1, 1e-9);
  EXPECT_LE(clearance, found.upper);
}

TEST(Migration, Tolerance) {
  const swept::Shape box = swept::makeBox({0.2, 0.2, 0.4});
  const swept::Shape ball = swept::makeSphere(0.1);
  for (const double x : {0.215, 0.225}) {
    const Eigen::Isometry3d box_from_ball = at(x);

    const swept::DistanceOptions within{.enough = 0.02, .contact = 0.02};
    const auto found = swept::distance(box, ball, box_from_ball, within);
    const bool farther = found.lower > 0.02;  // proven
    const bool nearer = found.upper <= 0.02;  // two points are known; perhaps neither

    EXPECT_EQ(farther, x > 0.22);
    EXPECT_EQ(nearer, x < 0.22);
  }
}

TEST(Migration, Meshes) {
  // A tetrahedron.
  const std::vector<Eigen::Vector3d> vertices = {
      {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  const std::vector<Eigen::Vector3i> triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

  const swept::Shape solid = swept::TriangleMesh::build(vertices, triangles);
  const swept::Shape surface =
      swept::TriangleMesh::build(vertices, triangles, swept::MeshInterior::Surface);

  const swept::Shape grain = swept::makeSphere(0.01);
  EXPECT_EQ(swept::collide(solid, grain, at(0.2, 0.2, 0.2)), swept::Contact::Touching);
  EXPECT_EQ(swept::collide(surface, grain, at(0.2, 0.2, 0.2)), swept::Contact::Separate);

  swept::BvhModel<swept::ObbRss> model;
  model.begin();
  model.addMesh(vertices, triangles);
  model.end();

  swept::MeshCollisionResult result;
  swept::collideMeshes(model, model, at(0.5), {.maxPairs = 100}, result);

  EXPECT_TRUE(result.touching);
}

TEST(Migration, FirstContact) {
  const swept::Shape box = swept::makeBox({0.2, 0.2, 0.4});
  const swept::Shape ball = swept::makeSphere(0.1);
  const Eigen::Isometry3d start = at(0.0), goal = at(1.0), world_from_ball = at(0.5);

  const auto moving = swept::UniformMotion::interpolation(start, goal);
  const auto still = swept::UniformMotion::still(world_from_ball);
  const auto result = swept::continuousCollide(box, moving, ball, still, {.margin = 0.0});
  const bool safe = result.verdict == swept::Verdict::Free;
  const double until = result.freeUntil;  // proven; the first contact is before result.contactBy

  EXPECT_FALSE(safe);
  EXPECT_NEAR(until, 0.3, 0.002);
  EXPECT_GE(result.contactBy, until);
}

TEST(Migration, ManyBodies) {
  const swept::Shape ball = swept::makeSphere(0.1);
  const swept::Shape box = swept::makeBox({0.2, 0.2, 0.4});

  const swept::BodyTree standing({{.id = 7, .shape = box, .world_from_body = at(0.0)},
                                  {.id = 8, .shape = box, .world_from_body = at(1.0)}});
  const swept::BodyTree::Hit hit = standing.collides(ball, at(0.9));
  const swept::BodyTree::Nearest nearest = standing.nearest(ball, at(0.3));

  EXPECT_EQ(hit.id, 8);
  EXPECT_NEAR(nearest.lower, 0.1, 1e-9);

  std::vector<std::pair<swept::BoxHandle, swept::BoxHandle>> pairs;
  swept::SweepAndPrune moving;
  const swept::BoxHandle a = moving.registerBox({{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}});
  const swept::BoxHandle b = moving.registerBox({{2.0, 0.0, 0.0}, {3.0, 1.0, 1.0}});
  moving.update(b, {{0.5, 0.0, 0.0}, {1.5, 1.0, 1.0}});
  moving.collide([&](swept::BoxHandle first, swept::BoxHandle second) {
    pairs.emplace_back(first, second);  // boxes overlap: ask collide() or distance() now
    return false;                       // go on
  });

  EXPECT_THAT(pairs, testing::ElementsAre(std::pair{a, b}));
}

TEST(Migration, Octree) {
  const std::string file = modelsDir() + "/clouds/shelf.bt";
  const Eigen::Isometry3d world_from_map = Eigen::Isometry3d::Identity();

  swept::World world;
  world.add(swept::occupiedBody("map", swept::loadOctomap(file), world_from_map));

  ASSERT_NE(world.find("map"), nullptr);
  EXPECT_FALSE(world.find("map")->parts.empty());
}

class MigrationOfARobot : public testing::Test {
 protected:
  const std::string folder = modelsDir() + "/robots/rook7/";
  const std::string urdf = folder + "rook7.urdf";
  const std::string srdf = folder + "rook7.srdf";
  const std::string scene = modelsDir() + "/scenes/shelf.yaml";
};

TEST_F(MigrationOfARobot, SceneRulesAndQueries) {
  const auto robot = swept::Robot::load(urdf, srdf);
  swept::World world = swept::World::load(scene);
  world.add("parcel", swept::makeBox({0.1, 0.1, 0.1}), at(0.3, 0.6, 0.05));

  swept::CollisionRules rules;
  rules.allow("hand", "board_1");
  rules.pad("link*", 0.01).scale("hand", 1.05);
  const swept::Checker checker(robot, "arm", std::make_shared<const swept::World>(world),
                               {.rules = rules});
  swept::Workspace workspace(checker);  // one for each thread

  const auto home = swept::namedConfiguration(*robot, checker.group(), "home");
  const auto ready = swept::namedConfiguration(*robot, checker.group(), "ready");
  const bool valid = checker.checkState(home, workspace) == swept::Verdict::Free;
  const auto motion = checker.certifyMotion(home, ready, workspace);
  const bool safe = motion.verdict == swept::Verdict::Free;  // every instant, not only waypoints

  EXPECT_TRUE(valid);
  EXPECT_TRUE(safe);
  EXPECT_THAT(checker.explain("hand", "board_1"), testing::HasSubstr("not checked"));

  const swept::Checker holding = checker.withoutBody("parcel").withAttached(
      "held", "hand", swept::makeBox({0.04, 0.04, 0.1}), at(0.0, 0.0, 0.1),
      {"finger_left", "finger_right"});
  const swept::Checker released =
      holding.withoutAttached("held").withBody(holding.detachedBody("held", ready));

  EXPECT_EQ(holding.world().find("parcel"), nullptr);
  EXPECT_NE(released.world().find("held"), nullptr);
}

TEST_F(MigrationOfARobot, Planning) {
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
  const auto robot = swept::Robot::load(urdf, srdf);
  const auto world = std::make_shared<const swept::World>(swept::World::load(scene));
  const auto checker = std::make_shared<const swept::Checker>(robot, "arm", world);

  const auto setup = swept::makeSimpleSetup(checker);
  const auto planner = std::make_shared<og::RRTConnect>(setup->getSpaceInformation());
  planner->params().setParam("range", "0.8");
  setup->setPlanner(planner);

  EXPECT_EQ(planner->getRange(), 0.8);
}

}  // namespace
}  // namespace swept::test
