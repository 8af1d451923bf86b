// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "../core/mesh_samples.hpp"
#include "model_robots.hpp"
#include "swept/robot_model/checker.hpp"
#include "version_arms.hpp"

/// What is proven of a mesh or a cloud by its clearance field and its hierarchy has to agree with
/// what is found about its triangles or balls as so many obstacles, which takes another way.
namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::uniform;

struct Worlds {
  std::shared_ptr<World> whole = std::make_shared<World>();
  std::shared_ptr<World> pieces = std::make_shared<World>();
};

Worlds meshWorlds(std::mt19937& random, MeshInterior interior) {
  Worlds worlds;
  test::Soup soup = test::torusSoup(14, 8, 0.3, 0.05).moved(test::randomPose(random, 0.7));
  soup.append(test::blobSoup(random, 6, 8).moved(test::randomPose(random, 0.7)));
  worlds.whole->add("mesh", TriangleMesh::build(soup.vertices, soup.triangles, interior),
                    Isometry3d::Identity());
  for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
    const auto& corner = soup.triangles[i];
    worlds.pieces->add(
        "triangle" + std::to_string(i),
        makeTriangle(soup.vertices[corner[0]], soup.vertices[corner[1]], soup.vertices[corner[2]]),
        Isometry3d::Identity());
  }
  return worlds;
}

Worlds cloudWorlds(std::mt19937& random) {
  Worlds worlds;
  constexpr double kRadius = 0.02;
  std::vector<Vector3d> points;
  for (int patch = 0; patch < 6; ++patch) {
    const Isometry3d pose = test::randomPose(random, 0.9);
    for (int i = 0; i < 40; ++i) {
      const Vector3d at = test::uniformPoint(random, 0.2);
      points.push_back(pose * Vector3d(at.x(), at.y(), 0.0));
    }
  }
  worlds.whole->add("cloud", PointCloud::build(points, kRadius), Isometry3d::Identity());
  for (std::size_t i = 0; i < points.size(); ++i)
    worlds.pieces->add("ball" + std::to_string(i), makeSphere(kRadius),
                       Isometry3d(Eigen::Translation3d(points[i])));
  return worlds;
}

struct Counts {
  int free = 0;
  int contacts = 0;
  int undecided = 0;
};

/// `surfaces`: there is nothing but triangles and balls, so contacts agree, too.
void compare(const Worlds& worlds, bool surfaces, std::mt19937& random, Counts& counts) {
  const auto robot = test::modelRobot("rook7");
  const Checker whole(robot, "arm", worlds.whole);
  const Checker pieces = whole.withWorld(worlds.pieces);
  Workspace ofWhole(whole);
  Workspace ofPieces(pieces);
  std::vector<double> from(static_cast<std::size_t>(whole.dimension()));
  std::vector<double> to(from.size());
  for (int i = 0; i < 100; ++i) {
    const double step = std::pow(10.0, -uniform(random, 0.0, 1.5));
    for (std::size_t k = 0; k < from.size(); ++k) {
      from[k] = uniform(random, -1.5, 1.5);
      to[k] = from[k] + step * uniform(random, -1.0, 1.0);
    }
    const auto first = whole.certifyMotion(from, to, ofWhole, MotionQuery::VerdictOnly);
    const auto second = pieces.certifyMotion(from, to, ofPieces, MotionQuery::VerdictOnly);
    if (first.verdict == Verdict::Free) {
      ASSERT_NE(second.verdict, Verdict::Collision) << i;
    }
    if (first.verdict == Verdict::Collision && surfaces) {
      ASSERT_NE(second.verdict, Verdict::Free) << i;
    }
    counts.free += first.verdict == Verdict::Free;
    counts.contacts += first.verdict == Verdict::Collision;
    counts.undecided += first.verdict == Verdict::Undecided;
    const Verdict state = whole.checkState(from, ofWhole);
    if (state == Verdict::Free) {
      ASSERT_NE(pieces.checkState(from, ofPieces), Verdict::Collision) << i;
    }
    if (state == Verdict::Collision) {
      ASSERT_NE(first.verdict, Verdict::Free) << i;
    }
  }
}

void expectRepresentative(const Counts& counts) {
  EXPECT_GT(counts.free, 60);
  EXPECT_GT(counts.contacts, 60);
  EXPECT_LT(counts.undecided, 20);
}

TEST(FieldWorlds, SurfacesAgreeWithTheirTriangles) {
  std::mt19937 random(31);
  Counts counts;
  for (int i = 0; i < 10; ++i)
    compare(meshWorlds(random, MeshInterior::Surface), true, random, counts);
  expectRepresentative(counts);
}

TEST(FieldWorlds, SolidsAreNoSmallerThanTheirTriangles) {
  std::mt19937 random(32);
  Counts counts;
  for (int i = 0; i < 10; ++i)
    compare(meshWorlds(random, MeshInterior::Solid), false, random, counts);
  expectRepresentative(counts);
}

TEST(FieldWorlds, CloudsAgreeWithTheirBalls) {
  std::mt19937 random(33);
  Counts counts;
  for (int i = 0; i < 10; ++i) compare(cloudWorlds(random), true, random, counts);
  expectRepresentative(counts);
}

/// Nearer to the surface than a cell of the field, which does not tell that they are inside.
TEST(FieldWorlds, PointsInsideAreNotFree) {
  std::string urdf = "<robot name='gantry'>" + test::urdfLink("frame", {}) +
                     test::urdfLink("beam", {}) + test::urdfLink("trolley", {}) +
                     test::urdfLink("ball", {{test::sphere(1e-3), {0, 0, 0}}});
  const std::string limits = "<limit lower='-3' upper='3' effort='1' velocity='1'/>";
  urdf += test::urdfJoint("x", "prismatic", "frame", "beam", "<axis xyz='1 0 0'/>" + limits) +
          test::urdfJoint("y", "prismatic", "beam", "trolley", "<axis xyz='0 1 0'/>" + limits) +
          test::urdfJoint("z", "prismatic", "trolley", "ball", "<axis xyz='0 0 1'/>" + limits) +
          "</robot>";
  std::mt19937 random(31);
  const test::Soup soup = test::torusSoup(28, 16, 0.9, 0.3).moved(test::randomPose(random, 0.5));
  const TriangleMesh mesh = TriangleMesh::build(soup.vertices, soup.triangles);
  const auto world = std::make_shared<World>();
  world->add("torus", mesh, Isometry3d::Identity());
  const Checker checker(Robot::parse(urdf, "gantry.urdf"), "all", world);
  Workspace workspace(checker);
  int inside = 0, outside = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto& corner = soup.triangles[random() % soup.triangles.size()];
    const Vector3d a = soup.vertices[corner[0]];
    const Vector3d b = soup.vertices[corner[1]], c = soup.vertices[corner[2]];
    const Vector3d normal = (b - a).cross(c - a).normalized();
    const double depth = (i % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, uniform(random, -2.5, -1.0));
    const Vector3d p = (a + b + c) / 3.0 + depth * normal;
    const Vector3d q = p + 2e-3 * test::unitVector(random);
    const std::vector<double> from{p.x(), p.y(), p.z()}, to{q.x(), q.y(), q.z()};
    const bool isInside = mesh.encloses(p);
    (isInside ? inside : outside) += 1;
    const Verdict wanted = isInside ? Verdict::Collision : Verdict::Free;
    ASSERT_EQ(checker.checkState(from, workspace), wanted) << depth;
    if (std::abs(depth) < 4e-3) continue;
    ASSERT_EQ(checker.certifyMotion(from, to, workspace).verdict, wanted) << depth;
  }
  EXPECT_GT(std::min(inside, outside), 1500);
}

}  // namespace
}  // namespace swept
