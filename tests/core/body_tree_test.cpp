// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/broadphase/body_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "broadphase/world_box.hpp"
#include "mesh_samples.hpp"

namespace swept::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Shape randomShape(std::mt19937& random, double size) {
  const auto length = [&] { return size * uniform(random, 0.1, 1.0); };
  switch (std::uniform_int_distribution<int>(0, 7)(random)) {
    case 0:
      return makeSphere(length());
    case 1: {
      const double x = length(), y = length();
      return makeBox({x, y, length()});
    }
    case 2: {
      const double radius = length();
      return makeCylinder(radius, length());
    }
    case 3: {
      const double radius = length();
      return makeCapsule(radius, length());
    }
    case 4: {
      const double radius = length();
      return makeCone(radius, length());
    }
    case 5: {
      const double x = length(), y = length();
      return makeEllipsoid({x, y, length()});
    }
    case 6: {
      std::vector<Vector3d> points;
      for (int i = 0; i < 10; ++i) points.push_back(uniformPoint(random, size));
      return ConvexHull::of(points);
    }
    default: {
      const Soup blob = blobSoup(random, 4, 5);
      std::vector<Vector3d> vertices;
      for (const Vector3d& v : blob.vertices) vertices.push_back(size * v);
      return TriangleMesh::build(vertices, blob.triangles);
    }
  }
}

std::vector<BodyTree::Body> randomBodies(std::mt19937& random, int count, double reach,
                                         double size) {
  std::vector<BodyTree::Body> bodies;
  for (int i = 0; i < count; ++i) {
    const Isometry3d pose = randomPose(random, reach);
    bodies.push_back({i, randomShape(random, size), pose});
  }
  return bodies;
}

Isometry3d at(double x, double y, double z) {
  Isometry3d pose = Isometry3d::Identity();
  pose.translation() = Vector3d(x, y, z);
  return pose;
}

bool overlap(const Aabb& a, const Aabb& b) {
  return (a.lower.array() <= b.upper.array()).all() && (b.lower.array() <= a.upper.array()).all();
}

/// Ids of the bodies that a box query visits, sorted.
std::vector<int> visited(const BodyTree& tree, const Aabb& box) {
  std::vector<int> ids;
  EXPECT_FALSE(tree.forEachOverlap(box, [&](const BodyTree::Body& body) {
    ids.push_back(body.id);
    return false;
  }));
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::vector<int> visitedByBruteForce(const BodyTree& tree, const Aabb& box) {
  std::vector<int> ids;
  for (const BodyTree::Body& body : tree.bodies()) {
    const Aabb own = detail::worldBox(body.shape, body.world_from_body, detail::BoxFit::Tight);
    if (overlap(own, box)) ids.push_back(body.id);
  }
  return ids;
}

TEST(WorldBox, TouchesTheShapeOnAllSides) {
  // A plane a little inside of a side of the box cuts the shape; a little outside it does not.
  std::mt19937 random(1);
  for (int i = 0; i < 400; ++i) {
    const Shape shape = randomShape(random, 1.0);
    const Isometry3d pose = randomPose(random, 3.0);
    const Aabb tight = detail::worldBox(shape, pose, detail::BoxFit::Tight);
    const Aabb quick = detail::worldBox(shape, pose, detail::BoxFit::Quick);
    for (int side = 0; side < 6; ++side) {
      Vector3d normal = Vector3d::Zero();
      normal[side % 3] = side < 3 ? 1.0 : -1.0;
      const double extent = side < 3 ? tight.upper[side] : -tight.lower[side - 3];
      const double roughly = side < 3 ? quick.upper[side] : -quick.lower[side - 3];
      EXPECT_GE(roughly, extent - 1e-12);
      // world_from_shape of the half-space's solid, which is ahead of the box's side.
      const HalfSpace outside = makeHalfSpace(-normal, -(extent + 1e-9));
      const HalfSpace inside = makeHalfSpace(-normal, -(extent - 1e-6));
      EXPECT_EQ(collide(outside, shape, pose), Contact::Separate) << i << " " << side;
      EXPECT_EQ(collide(inside, shape, pose), Contact::Touching) << i << " " << side;
    }
  }
}

TEST(BodyTree, BoxQueriesVisitWhatBruteForceFinds) {
  std::mt19937 random(2);
  std::size_t found = 0, most = 0;
  for (const int count : {1, 2, 3, 17, 300}) {
    const BodyTree tree(randomBodies(random, count, 5.0, 0.5));
    for (int i = 0; i < 200; ++i) {
      const Vector3d center = uniformPoint(random, 6.0);
      const Vector3d half = Vector3d::Constant(uniform(random, 0.0, 2.0));
      const Aabb box{center - half, center + half};
      EXPECT_EQ(visited(tree, box), visitedByBruteForce(tree, box));
      found += visited(tree, box).size();
      most += static_cast<std::size_t>(count);
    }
  }
  EXPECT_GT(found, most / 100);
  EXPECT_LT(found, most / 3);
}

TEST(BodyTree, StopsWhenTheVisitorSaysSo) {
  std::mt19937 random(3);
  const BodyTree tree(randomBodies(random, 50, 1.0, 0.5));
  const Aabb all{Vector3d::Constant(-10.0), Vector3d::Constant(10.0)};
  int calls = 0;
  EXPECT_TRUE(tree.forEachOverlap(all, [&](const BodyTree::Body&) { return ++calls == 7; }));
  EXPECT_EQ(calls, 7);
  EXPECT_EQ(visited(tree, all).size(), 50u);
}

TEST(BodyTree, CollidesAgreesWithAllPairs) {
  std::mt19937 random(4);
  const BodyTree tree(randomBodies(random, 60, 4.0, 0.6));
  int touching = 0, free = 0;
  for (int i = 0; i < 600; ++i) {
    const Shape shape = randomShape(random, 0.8);
    const Isometry3d pose = randomPose(random, 3.5);
    std::vector<int> hits;
    bool unknown = false;
    for (const BodyTree::Body& body : tree.bodies()) {
      const Contact contact = collide(shape, body.shape, pose.inverse() * body.world_from_body);
      if (contact == Contact::Touching) hits.push_back(body.id);
      unknown |= contact == Contact::Unknown;
    }
    const BodyTree::Hit hit = tree.collides(shape, pose);
    if (unknown) continue;
    EXPECT_EQ(hit.status, hits.empty() ? Contact::Separate : Contact::Touching);
    if (!hits.empty()) {
      EXPECT_NE(std::find(hits.begin(), hits.end(), hit.id), hits.end());
    }
    ++(hits.empty() ? free : touching);
  }
  EXPECT_GT(touching, 120);
  EXPECT_GT(free, 120);
}

TEST(BodyTree, NearestAgreesWithAllPairs) {
  std::mt19937 random(5);
  const BodyTree tree(randomBodies(random, 60, 4.0, 0.4));
  int apart = 0;
  for (int i = 0; i < 300; ++i) {
    const Shape shape = randomShape(random, 0.4);
    const Isometry3d pose = randomPose(random, 7.0);
    double lower = kInfinity, upper = kInfinity;
    for (const BodyTree::Body& body : tree.bodies()) {
      const DistanceResult pair =
          distance(shape, body.shape, pose.inverse() * body.world_from_body);
      lower = std::min(lower, pair.lower);
      upper = std::min(upper, pair.upper);
    }
    const BodyTree::Nearest nearest = tree.nearest(shape, pose);
    EXPECT_LE(nearest.lower, upper + 1e-12);
    EXPECT_GE(nearest.upper, lower - 1e-12);
    EXPECT_LE(nearest.lower, nearest.upper);
    EXPECT_LE(nearest.upper - nearest.lower, 1.1e-9);
    EXPECT_NEAR((nearest.pointOfShape - nearest.pointOfBody).norm(), nearest.upper, 1e-9);
    ASSERT_GE(nearest.id, 0);
    const BodyTree::Body& body = tree.bodies()[static_cast<std::size_t>(nearest.id)];
    EXPECT_NEAR(distance(shape, body.shape, pose.inverse() * body.world_from_body).upper,
                nearest.upper, 2e-9);
    apart += upper > 0.0;
  }
  EXPECT_GT(apart, 90);
  EXPECT_LT(apart, 300);
}

TEST(BodyTree, SizesAndDistancesMayDifferByManyOrders) {
  std::mt19937 random(6);
  std::vector<BodyTree::Body> bodies;
  for (int i = 0; i < 120; ++i) {
    const double scale = std::pow(10.0, uniform(random, -6.0, 6.0));
    const Vector3d place = scale * 2.5 * unitVector(random);
    bodies.push_back({i, makeSphere(scale), at(place.x(), place.y(), place.z())});
  }
  const BodyTree tree(bodies);
  int touching = 0;
  for (int i = 0; i < 400; ++i) {
    const double scale = std::pow(10.0, uniform(random, -6.0, 6.0));
    const Vector3d place = scale * 2.5 * unitVector(random);
    double gap = kInfinity;
    for (const BodyTree::Body& body : bodies) {
      gap = std::min(gap, (body.world_from_body.translation() - place).norm() -
                              std::get<Sphere>(body.shape).radius - scale);
    }
    const BodyTree::Nearest nearest =
        tree.nearest(makeSphere(scale), at(place.x(), place.y(), place.z()));
    const double slack = 1e-9 + 1e-12 * scale;
    EXPECT_LE(nearest.lower, std::max(0.0, gap) + slack);
    EXPECT_GE(nearest.upper, gap - slack);
    touching += gap < 0.0;
  }
  EXPECT_GT(touching, 20);
  EXPECT_LT(touching, 380);
}

TEST(BodyTree, IdenticalBodiesAreAllFoundAndOneIsNearest) {
  std::vector<BodyTree::Body> bodies;
  for (int i = 0; i < 1000; ++i) bodies.push_back({i, makeBox({1.0, 1.0, 1.0}), at(2.0, 0.0, 0.0)});
  const BodyTree tree(bodies);
  EXPECT_EQ(visited(tree, {Vector3d::Zero(), Vector3d::Constant(2.0)}).size(), 1000u);
  EXPECT_EQ(tree.collides(makeSphere(0.5), at(1.0, 0.0, 0.0)).status, Contact::Touching);
  EXPECT_EQ(tree.collides(makeSphere(0.5), at(0.0, 0.0, 0.0)).status, Contact::Separate);
  const BodyTree::Nearest nearest = tree.nearest(makeSphere(0.5), at(0.0, 0.0, 0.0));
  EXPECT_NEAR(nearest.upper, 1.0, 1e-9);
  EXPECT_GE(nearest.id, 0);
}

TEST(BodyTree, UnboundedBodiesAreLookedAtEverywhere) {
  std::mt19937 random(9);
  std::vector<BodyTree::Body> bodies = randomBodies(random, 20, 1.0, 0.2);
  bodies.push_back({77, makeHalfSpace({0.0, 0.0, 1.0}, -3.0), Isometry3d::Identity()});
  bodies.push_back({78, makePlane({1.0, 0.0, 0.0}, 5.0), Isometry3d::Identity()});
  const BodyTree tree(bodies);
  const BodyTree::Hit ground = tree.collides(makeSphere(0.5), at(-900.0, 40.0, -2.6));
  EXPECT_EQ(ground.status, Contact::Touching);
  EXPECT_EQ(ground.id, 77);
  EXPECT_EQ(tree.collides(makeSphere(0.5), at(-900.0, 40.0, -2.4)).status, Contact::Separate);
  const BodyTree::Nearest wall = tree.nearest(makeSphere(0.5), at(4.0, 60.0, 60.0));
  EXPECT_EQ(wall.id, 78);
  EXPECT_NEAR(wall.upper, 0.5, 1e-9);
  EXPECT_NEAR(wall.lower, 0.5, 2e-9);
  // A half-space as the question.
  EXPECT_EQ(tree.collides(makeHalfSpace({0.0, 0.0, -1.0}, -10.0), Isometry3d::Identity()).status,
            Contact::Touching)
      << "every half-space meets a plane that is not parallel to it";
}

TEST(BodyTree, WithoutBodiesEverythingIsFree) {
  const BodyTree tree;
  EXPECT_EQ(tree.collides(makeSphere(1.0), at(0.0, 0.0, 0.0)).status, Contact::Separate);
  const BodyTree::Nearest nearest = tree.nearest(makeSphere(1.0), at(0.0, 0.0, 0.0));
  EXPECT_EQ(nearest.lower, kInfinity);
  EXPECT_EQ(nearest.upper, kInfinity);
  EXPECT_EQ(nearest.id, -1);
}

TEST(BodyTree, WhatIsNotFiniteIsNeverFree) {
  std::mt19937 random(10);
  std::vector<BodyTree::Body> bodies = randomBodies(random, 30, 1.0, 0.2);
  const BodyTree good(bodies);
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    EXPECT_EQ(good.collides(makeSphere(0.1), at(bad, 50.0, 0.0)).status, Contact::Unknown);
    EXPECT_EQ(BodyTree().collides(makeSphere(0.1), at(bad, 0.0, 0.0)).status, Contact::Unknown);
    const BodyTree::Nearest none = good.nearest(makeSphere(0.1), at(0.0, bad, 0.0));
    EXPECT_EQ(none.lower, 0.0);
    EXPECT_EQ(none.upper, kInfinity);
    const Aabb box{Vector3d::Constant(kNan), Vector3d::Constant(kNan)};
    EXPECT_EQ(visited(good, box).size(), bodies.size());

    std::vector<BodyTree::Body> broken = bodies;
    broken[11].world_from_body.translation().z() = bad;
    const BodyTree tree(broken);
    const BodyTree::Hit hit = tree.collides(makeSphere(0.1), at(50.0, 0.0, 0.0));
    EXPECT_EQ(hit.status, Contact::Unknown);
    EXPECT_EQ(hit.id, 11);
    EXPECT_EQ(tree.nearest(makeSphere(0.1), at(50.0, 0.0, 0.0)).lower, 0.0);
  }
  // Finite numbers whose box is not.
  std::vector<BodyTree::Body> huge = bodies;
  huge[3] = {3, makeSphere(1e308), at(1.7e308, 0.0, 0.0)};
  EXPECT_NE(BodyTree(huge).collides(makeSphere(0.1), at(1e308, 0.0, 0.0)).status,
            Contact::Separate);
}

}  // namespace
}  // namespace swept::test
