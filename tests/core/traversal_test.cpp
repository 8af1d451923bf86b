// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/traversal/traversal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

#include "all_volumes.hpp"
#include "mesh_samples.hpp"
#include "swept/core/traversal/mesh_collision.hpp"
#include "swept/core/traversal/mesh_distance.hpp"
#include "swept/core/traversal/mesh_self_collision.hpp"
#include "swept/core/traversal/mesh_shape.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::Vector3i;
using test::Soup;
using Pairs = std::vector<TrianglePair>;

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

const std::map<std::string, SplitFunction>& splitRules() {
  static const std::map<std::string, SplitFunction> rules{{"mean", MeanSplit{}},
                                                          {"median", MedianSplit{}},
                                                          {"principal axis", PrincipalAxisSplit{}},
                                                          {"surface area", SurfaceAreaSplit{}}};
  return rules;
}

template <typename BV>
BvhModel<BV> modelOf(const Soup& soup, const SplitFunction& split = MeanSplit{}, int maxLeaf = 2) {
  BvhModel<BV> model({split, defaultFit<BV>(), maxLeaf});
  model.begin(soup.vertices.size(), soup.triangles.size());
  model.addMesh(soup.vertices, soup.triangles);
  model.end();
  return model;
}

TriangleCorners corners(const Soup& soup, int t) {
  const Vector3i& v = soup.triangles[t];
  return {soup.vertices[v[0]], soup.vertices[v[1]], soup.vertices[v[2]]};
}

/// The truth, from all pairs of triangles.
struct Truth {
  Pairs touching;
  double distance = std::numeric_limits<double>::infinity();
  Vector3d pointA, pointB;  ///< nearest ones
};

Truth bruteForce(const Soup& a, const Soup& b, const Isometry3d& a_from_b) {
  Truth truth;
  const Soup there = b.moved(a_from_b);
  for (int t = 0; t < static_cast<int>(a.triangles.size()); ++t) {
    for (int u = 0; u < static_cast<int>(b.triangles.size()); ++u) {
      const TriangleCorners first = corners(a, t);
      const TriangleCorners second = corners(there, u);
      if (trianglesTouch(first, second)) truth.touching.push_back({t, u});
      const TriangleDistance d = triangleDistance(first, second, truth.distance);
      if (d.upper >= truth.distance) continue;
      truth.distance = d.upper;
      truth.pointA = d.pointA;
      truth.pointB = d.pointB;
    }
  }
  return truth;
}

struct Case {
  std::string name;
  Soup a;
  Soup b;
  Isometry3d a_from_b;
  Truth truth;
};

Soup slivers(std::mt19937& random, int count) {
  Soup soup;
  for (int i = 0; i < count; ++i) {
    const Vector3d at = test::uniformPoint(random, 0.7);
    const Vector3d along = 0.5 * test::unitVector(random);
    const Vector3d across = 1e-5 * test::unitVector(random);
    soup.append({{at, at + along, at + across}, {{0, 1, 2}}});
  }
  return soup;
}

Soup sheet(std::mt19937& random, int n) {
  Soup soup;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      soup.vertices.emplace_back(2.0 * i / n - 1.0, 2.0 * j / n - 1.0,
                                 test::uniform(random, 0.0, 1e-9));
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int v = i * (n + 1) + j;
      soup.triangles.emplace_back(v, v + 1, v + n + 1);
      soup.triangles.emplace_back(v + 1, v + n + 2, v + n + 1);
    }
  }
  return soup;
}

/// Such that b keeps `gap` from a or, below zero, goes so deep into it: from where they are apart,
/// on the way between nearest points.
Isometry3d nearlyTouching(const Soup& a, const Soup& b, double gap, std::mt19937& random) {
  for (int tries = 0; tries < 100; ++tries) {
    Isometry3d pose = test::randomPose(random, 3.0);
    const Truth there = bruteForce(a, b, pose);
    if (!there.touching.empty()) continue;
    const Vector3d way = there.pointB - there.pointA;
    pose.translation() -= (1.0 - gap / way.norm()) * way;
    return pose;
  }
  throw std::runtime_error("no pose keeps the meshes apart");
}

/// Random pairs of all kinds of meshes; in three of nine poses they touch or nearly so, or b lies
/// almost where a is.
std::vector<Case> makeCases() {
  std::mt19937 random(41);
  const Soup blob = test::blobSoup(random, 8, 16);
  const Soup other = test::blobSoup(random, 9, 15);
  Soup doubled = test::blobSoup(random, 6, 10);
  doubled.append(doubled);
  const std::vector<std::tuple<std::string, Soup, Soup, double>> kinds{
      {"bumpy spheres", blob, other, 1.1},
      {"slivers", slivers(random, 250), slivers(random, 250), 0.8},
      {"flat sheets", sheet(random, 10), sheet(random, 11), 1.4},
      {"sheet and sphere", sheet(random, 10), blob, 1.3},
      {"duplicates", doubled, doubled, 1.1}};
  std::vector<Case> cases;
  for (const auto& [name, a, b, reach] : kinds) {
    for (int i = 0; i < 9; ++i) {
      Case c{name, a, b, test::randomPose(random, reach), {}};
      if (i == 2) c.a_from_b = nearlyTouching(a, b, 1e-9, random);
      if (i == 5) c.a_from_b = nearlyTouching(a, b, -1e-9, random);
      if (i == 8) c.a_from_b = Isometry3d(Eigen::Translation3d(0.0, 0.0, 8e-7));
      c.truth = bruteForce(c.a, c.b, c.a_from_b);
      cases.push_back(c);
    }
  }
  return cases;
}

const std::vector<Case>& allCases() {
  static const std::vector<Case> cases = makeCases();
  return cases;
}

TEST(Soup, AppendedToItselfIsThereTwice) {
  std::mt19937 random(40);
  const Soup once = test::blobSoup(random, 6, 10);
  Soup twice = once;
  twice.append(twice);
  ASSERT_EQ(twice.triangles.size(), 2 * once.triangles.size());
  for (std::size_t i = 0; i < once.triangles.size(); ++i) {
    const auto t = static_cast<int>(i);
    EXPECT_EQ(corners(twice, t), corners(once, t));
    EXPECT_EQ(corners(twice, t + static_cast<int>(once.triangles.size())), corners(once, t));
  }
}

TEST(TraversalCases, AreRepresentative) {
  std::size_t touching = 0, near = 0, shallow = 0;
  for (const Case& c : allCases()) {
    touching += !c.truth.touching.empty();
    near += c.truth.distance > 0.0 && c.truth.distance < 2e-9;
    shallow += !c.truth.touching.empty() && c.truth.touching.size() <= 32;
  }
  EXPECT_GE(near, 5U);
  EXPECT_GE(shallow, 5U);
  EXPECT_GT(touching, 0.3 * static_cast<double>(allCases().size()));
  EXPECT_LT(touching, 0.7 * static_cast<double>(allCases().size()));
}

template <typename BV>
class Traversals : public testing::Test {};
TYPED_TEST_SUITE(Traversals, test::AllVolumes);

TYPED_TEST(Traversals, CollisionEqualsBruteForceForEverySplitRule) {
  MeshCollisionResult result;
  for (const auto& [rule, split] : splitRules()) {
    for (const Case& c : allCases()) {
      SCOPED_TRACE(rule + ", " + c.name);
      const auto a = modelOf<TypeParam>(c.a, split);
      const auto b = modelOf<TypeParam>(c.b, split, 1);
      collideMeshes(a, b, c.a_from_b, {kAll}, result);
      std::sort(result.pairs.begin(), result.pairs.end());
      EXPECT_EQ(result.pairs, c.truth.touching);
      EXPECT_EQ(result.touching, !c.truth.touching.empty());
      EXPECT_LT(result.effort.leafTests,
                static_cast<std::int64_t>(c.a.triangles.size() * c.b.triangles.size()) / 2);

      collideMeshes(a, b, c.a_from_b, {1}, result);
      EXPECT_EQ(result.touching, !c.truth.touching.empty());
      EXPECT_EQ(result.pairs.size(), result.touching ? 1U : 0U);
      collideMeshes(a, b, c.a_from_b, {3}, result);
      EXPECT_EQ(result.pairs.size(), std::min<std::size_t>(3, c.truth.touching.size()));
    }
  }
}

TYPED_TEST(Traversals, DistanceEqualsBruteForceForEverySplitRule) {
  for (const auto& [rule, split] : splitRules()) {
    for (const Case& c : allCases()) {
      SCOPED_TRACE(rule + ", " + c.name);
      const auto a = modelOf<TypeParam>(c.a, split);
      const auto b = modelOf<TypeParam>(c.b, split, 1);
      const MeshDistanceResult d = meshDistance(a, b, c.a_from_b);
      EXPECT_NEAR(d.upper, c.truth.distance, 1e-9 * c.truth.distance + 1e-15);
      EXPECT_LE(d.lower, c.truth.distance);
      EXPECT_GE(d.lower, c.truth.distance - 1e-12);
      EXPECT_NEAR((d.pointB - d.pointA).norm(), d.upper, 1e-14);
      EXPECT_EQ(d.upper == 0.0, !c.truth.touching.empty());
      ASSERT_GE(d.triangleA, 0);
      const TriangleCorners onA = corners(c.a, d.triangleA);
      EXPECT_LT(triangleDistance(onA, {d.pointA, d.pointA, d.pointA}).upper, 1e-13);
      const TriangleCorners onB = corners(c.b.moved(c.a_from_b), d.triangleB);
      EXPECT_LT(triangleDistance(onB, {d.pointB, d.pointB, d.pointB}).upper, 1e-13);

      const MeshDistanceResult coarse = meshDistance(a, b, c.a_from_b, {0.01, 0.1});
      EXPECT_LE(coarse.lower, c.truth.distance);
      EXPECT_GE(coarse.upper, c.truth.distance * (1.0 - 1e-12));
      EXPECT_LE(coarse.upper - coarse.lower, 0.01 + 0.1 * coarse.upper + 1e-12);
      EXPECT_LE(coarse.effort.bvTests, d.effort.bvTests);
    }
  }
}

/// A crumpled surface that passes through itself, with duplicated triangles, and its truth.
Soup crumpled() {
  std::mt19937 random(42);
  Soup soup = test::torusSoup(16, 10, 0.5, 0.45);
  for (Vector3d& v : soup.vertices) v += test::uniformPoint(random, 0.06);
  soup.triangles.push_back(soup.triangles.front());  // shares vertices: skipped
  Soup copy{soup.vertices, {soup.triangles[5], soup.triangles[77]}};
  soup.append(copy);  // the same places, other vertices: touches
  return soup;
}

Pairs bruteForceSelf(const Soup& soup) {
  Pairs pairs;
  for (int t = 0; t < static_cast<int>(soup.triangles.size()); ++t) {
    for (int u = t + 1; u < static_cast<int>(soup.triangles.size()); ++u) {
      bool shared = false;
      for (const int v : soup.triangles[t]) {
        shared = shared || (soup.triangles[u].array() == v).any();
      }
      if (!shared && trianglesTouch(corners(soup, t), corners(soup, u))) pairs.push_back({t, u});
    }
  }
  return pairs;
}

TYPED_TEST(Traversals, SelfCollisionEqualsBruteForceForEverySplitRule) {
  const Soup soup = crumpled();
  const Pairs truth = bruteForceSelf(soup);
  ASSERT_GT(truth.size(), 10U);
  MeshCollisionResult result;
  for (const auto& [rule, split] : splitRules()) {
    for (const int maxLeaf : {1, 4}) {
      SCOPED_TRACE(rule);
      const auto model = modelOf<TypeParam>(soup, split, maxLeaf);
      selfCollideMesh(model, {kAll}, result);
      std::sort(result.pairs.begin(), result.pairs.end());
      EXPECT_EQ(result.pairs, truth);
      selfCollideMesh(model, {1}, result);
      EXPECT_TRUE(result.touching);
      EXPECT_EQ(result.pairs.size(), 1U);
    }
    const auto clean = modelOf<TypeParam>(test::torusSoup(16, 10, 1.0, 0.3), split);
    selfCollideMesh(clean, {1}, result);
    EXPECT_FALSE(result.touching);
  }
}

TYPED_TEST(Traversals, RefittedModelsEqualBruteForce) {
  std::mt19937 random(43);
  Soup soup = test::blobSoup(random, 8, 16);
  const Soup still = test::blobSoup(random, 8, 16);
  auto replaced = modelOf<TypeParam>(soup);
  auto updated = modelOf<TypeParam>(soup);
  const auto other = modelOf<TypeParam>(still);
  int touching = 0;
  constexpr int kSteps = 10;
  MeshCollisionResult result;
  for (int step = 0; step < kSteps; ++step) {
    for (Vector3d& v : soup.vertices) {
      v += 0.1 * Vector3d(std::sin(3.0 * v.y()), std::cos(2.0 * v.x()) - 0.8, 0.3 * v.z());
    }
    replaced.beginReplace();
    replaced.replaceVertices(0, soup.vertices);
    replaced.endReplace(Refresh::Refit);
    updated.beginUpdate();
    updated.updateVertices(0, soup.vertices);
    updated.endUpdate(Refresh::Refit);
    const Isometry3d pose = test::randomPose(random, 1.9);
    const Truth truth = bruteForce(soup, still, pose);
    for (const auto* model : {&replaced, &updated}) {
      collideMeshes(*model, other, pose, {kAll}, result);
      std::sort(result.pairs.begin(), result.pairs.end());
      EXPECT_EQ(result.pairs, truth.touching) << step;
      EXPECT_NEAR(meshDistance(*model, other, pose).upper, truth.distance, 1e-9);
    }
    touching += !truth.touching.empty();
  }
  EXPECT_GE(touching, 3);
  EXPECT_LE(touching, 7);
}

TYPED_TEST(Traversals, MeshAndShapeEqualBruteForce) {
  std::mt19937 random(44);
  const Soup soup = test::blobSoup(random, 6, 10);
  const auto mesh = modelOf<TypeParam>(soup);
  Soup tetrahedron{{{0, 0, 0}, {0.4, 0, 0}, {0, 0.5, 0}, {0, 0, 0.6}}, {}};
  const std::vector<Shape> shapes{makeSphere(0.3), makeBox({0.5, 0.4, 0.2}), makeCapsule(0.1, 0.6),
                                  ConvexHull::of(tetrahedron.vertices)};
  int touching = 0;
  int total = 0;
  for (int i = 0; i < 24; ++i) {
    const Shape& shape = shapes[i % shapes.size()];
    const Isometry3d pose = test::randomPose(random, 0.95);
    Contact truth = Contact::Separate;
    double least = std::numeric_limits<double>::infinity();
    double proven = std::numeric_limits<double>::infinity();
    for (int t = 0; t < static_cast<int>(soup.triangles.size()); ++t) {
      const Shape triangle = Triangle{corners(soup, t)};
      const DistanceResult d = distance(triangle, shape, pose);
      least = std::min(least, d.upper);
      proven = std::min(proven, d.lower);
      if (collide(triangle, shape, pose) == Contact::Touching) truth = Contact::Touching;
    }
    const MeshShapeCollisionResult hit = collideMeshShape(mesh, shape, pose);
    EXPECT_EQ(hit.contact, truth) << i;
    EXPECT_EQ(hit.triangle >= 0, truth == Contact::Touching);
    const MeshDistanceResult d = meshShapeDistance(mesh, shape, pose);
    EXPECT_NEAR(d.upper, least, 2e-9) << i;
    EXPECT_LE(d.lower, least);
    EXPECT_GE(d.lower, proven - 2e-9);
    EXPECT_NEAR((d.pointB - d.pointA).norm(), d.upper, 1e-9);
    EXPECT_LT(d.effort.leafTests, static_cast<std::int64_t>(soup.triangles.size()));
    touching += truth == Contact::Touching;
    ++total;
  }
  EXPECT_GT(touching, 0.3 * total);
  EXPECT_LT(touching, 0.7 * total);
}

TEST(MeshShape, UnboundedShapesAreTestedAgainstAllTriangles) {
  std::mt19937 random(45);
  const auto mesh = modelOf<Obb>(test::blobSoup(random, 6, 10));
  const Shape ground = makeHalfSpace({0, 0, 1}, 0.0);
  Isometry3d pose = Isometry3d::Identity();
  EXPECT_EQ(collideMeshShape(mesh, ground, pose).contact, Contact::Touching);
  pose.translation().z() = -1.5;
  EXPECT_EQ(collideMeshShape(mesh, ground, pose).contact, Contact::Separate);
  const MeshDistanceResult d = meshShapeDistance(mesh, ground, pose);
  double lowest = 1.0;
  for (const Vector3d& v : mesh.vertices()) lowest = std::min(lowest, v.z());
  EXPECT_NEAR(d.upper, lowest + 1.5, 1e-9);
}

TEST(Traversal, PosesThatAreNotFiniteFailSafe) {
  std::mt19937 random(46);
  const auto mesh = modelOf<ObbRss>(test::blobSoup(random, 6, 10));
  Isometry3d pose = Isometry3d::Identity();
  pose.translation().y() = std::numeric_limits<double>::quiet_NaN();
  MeshCollisionResult result;
  collideMeshes(mesh, mesh, pose, {kAll}, result);
  EXPECT_TRUE(result.touching);
  EXPECT_TRUE(result.pairs.empty());
  const MeshDistanceResult d = meshDistance(mesh, mesh, pose);
  EXPECT_EQ(d.lower, 0.0);
  EXPECT_EQ(d.upper, std::numeric_limits<double>::infinity());
  EXPECT_EQ(collideMeshShape(mesh, makeSphere(0.1), pose).contact, Contact::Unknown);
  EXPECT_EQ(meshShapeDistance(mesh, makeSphere(0.1), pose).lower, 0.0);
}

TEST(Traversal, ModelsThatAreNotReadyAreRefused) {
  const BvhModel<Aabb> empty;
  MeshCollisionResult result;
  EXPECT_THROW(collideMeshes(empty, empty, Isometry3d::Identity(), {}, result), BvhStateError);
  BvhModel<Aabb> cloud;
  cloud.begin();
  cloud.addPoint({0, 0, 0}, 0.1);
  cloud.end();
  EXPECT_THROW(meshDistance(cloud, cloud, Isometry3d::Identity()), std::invalid_argument);
  EXPECT_THROW(collideMeshShape(cloud, makeSphere(1.0), Isometry3d::Identity()),
               std::invalid_argument);
}

TEST(Traversal, CoordinatesAndScalesDoNotMatter) {
  // The same pair at 1e-6, 1 and 1e6 times the size gives the same pairs and scaled distances.
  std::mt19937 random(47);
  const Soup a = test::blobSoup(random, 8, 12);
  const Soup b = test::blobSoup(random, 8, 12);
  for (int i = 0; i < 6; ++i) {
    const Isometry3d pose = test::randomPose(random, 1.2);
    double unit = 0.0;
    for (const double scale : {1.0, 1e-6, 1e6}) {
      Soup scaledA = a;
      Soup scaledB = b;
      for (Soup* soup : {&scaledA, &scaledB}) {
        for (Vector3d& v : soup->vertices) v *= scale;
      }
      Isometry3d scaledPose = pose;
      scaledPose.translation() *= scale;
      const double d = meshDistance(modelOf<Rss>(scaledA), modelOf<Rss>(scaledB), scaledPose).upper;
      if (scale == 1.0) unit = d;
      EXPECT_NEAR(d / scale, unit, 1e-12);
    }
  }
}

}  // namespace
}  // namespace swept
