// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "all_volumes.hpp"
#include "heap_counter.hpp"
#include "mesh_samples.hpp"
#include "swept/core/broadphase/body_tree.hpp"
#include "swept/core/contacts.hpp"
#include "swept/core/continuous/continuous_collide.hpp"
#include "swept/core/continuous/impact.hpp"
#include "swept/core/continuous/motions.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/separation.hpp"
#include "swept/core/signed_distance.hpp"
#include "swept/core/traversal/mesh_collision.hpp"
#include "swept/core/traversal/mesh_distance.hpp"
#include "swept/core/traversal/mesh_self_collision.hpp"
#include "swept/core/traversal/mesh_shape.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;

std::vector<Shape> everyKind() {
  std::mt19937 random(1);
  const test::Soup blob = test::blobSoup(random, 10, 12);
  std::vector<Vector3d> points;
  for (int i = 0; i < 40; ++i) points.push_back(0.5 * test::unitVector(random));
  return {makeSphere(0.4),
          makeBox({0.5, 0.6, 0.7}),
          makeCylinder(0.3, 0.8),
          makeCapsule(0.2, 0.7),
          makeCone(0.4, 0.9),
          makeEllipsoid({0.3, 0.4, 0.6}),
          ConvexHull::of(points),
          makeTriangle({0, 0, 0}, {0.6, 0, 0}, {0, 0.7, 0.2}),
          makePlane(Vector3d::UnitZ(), 0.1),
          makeHalfSpace(Vector3d::UnitX(), -0.2),
          TriangleMesh::build(blob.vertices, blob.triangles),
          PointCloud::build(points, 0.05)};
}

/// The counter itself: each once, whoever asks and however it is aligned.
TEST(HeapCounter, CountsNewAndWhatEigenTakes) {
  struct alignas(64) Wide {
    double values[8];
  };
  const long before = test::allocations, held = test::heldBytes;
  {
    const Eigen::VectorXd zeros = Eigen::VectorXd::Zero(1000);
    EXPECT_EQ(test::allocations, before + 1);
    EXPECT_GE(test::heldBytes, held + 8000);
    EXPECT_EQ(zeros.sum(), 0.0);
    const std::vector<double> ones(1000, 1.0);
    EXPECT_EQ(test::allocations, before + 2);
    EXPECT_GE(test::heldBytes, held + 16000);
    EXPECT_EQ(ones.back(), 1.0);
    const std::vector<Wide> wide(10);
    EXPECT_EQ(test::allocations, before + 3);
    EXPECT_EQ(wide.back().values[7], 0.0);
  }
  EXPECT_EQ(test::heldBytes, held);
}

TEST(Queries, AllocateNothing) {
  std::mt19937 random(2);
  const std::vector<Shape> shapes = everyKind();
  ASSERT_EQ(shapes.size(), std::variant_size_v<Shape>);
  std::vector<ContactPoint> contacts;
  contacts.reserve(1 << 16);
  SeparationQuery query;
  query.approach.travel = 0.05;
  const long before = test::allocations;
  int touching = 0, total = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (std::size_t j = 0; j < shapes.size(); ++j) {
      for (int round = 0; round < 6; ++round) {
        const Eigen::Isometry3d pose = test::randomPose(random, 0.8);
        const DistanceResult found = distance(shapes[i], shapes[j], pose);
        touching += found.upper <= 0.0 ? 1 : 0;
        ++total;
        collide(shapes[i], shapes[j], pose);
        signedDistance(shapes[i], shapes[j], pose);
        separate(shapes[i], shapes[j], pose, query);
        contacts.clear();
        findContacts(shapes[i], shapes[j], pose, contacts.capacity(), contacts);
      }
      ASSERT_EQ(test::allocations, before) << "kinds " << i << " and " << j;
    }
  }
  EXPECT_GT(touching, total / 5);
  EXPECT_LT(touching, total * 9 / 10);
}

/// Once its memory has grown to what it is used for.
TEST(ContinuousCollide, AllocatesNothingTheSecondTime) {
  const std::vector<Shape> shapes = everyKind();
  ContinuousWorkspace workspace;
  ContinuousOptions options;
  options.tolerance = 1e-5;
  int hits = 0, total = 0;
  const auto round = [&] {
    std::mt19937 random(3);
    hits = total = 0;
    for (const Shape& a : shapes) {
      for (const Shape& b : shapes) {
        const auto motion = [&] {
          const Eigen::Isometry3d start = test::randomPose(random, 1.5);
          return UniformMotion::turning(start, 2.0 * test::unitVector(random),
                                        -1.5 * start.translation());
        };
        const UniformMotion first = motion(), second = motion();
        const ContinuousResult found = continuousCollide(a, first, b, second, options, workspace);
        hits += found.verdict == Verdict::Collision && found.contactBy > 0.0 ? 1 : 0;
        ++total;
      }
    }
  };
  round();
  const long before = test::allocations;
  round();
  EXPECT_EQ(test::allocations, before);
  EXPECT_GT(hits, total / 5);
}

TEST(BodyTree, QueriesAllocateNothing) {
  std::mt19937 random(4);
  const std::vector<Shape> shapes = everyKind();
  std::vector<BodyTree::Body> bodies;
  for (int i = 0; i < 200; ++i) {
    // Planes and half-spaces, which nearly everything touches, stay out of most of the world.
    const Shape& shape = shapes[static_cast<std::size_t>(i) % 8];
    bodies.push_back({i, shape, test::randomPose(random, 6.0)});
  }
  bodies.push_back({200, makeHalfSpace(Vector3d::UnitZ(), -5.0), Eigen::Isometry3d::Identity()});
  bodies.push_back({201, shapes[10], test::randomPose(random, 1.0)});
  bodies.push_back({202, shapes[11], test::randomPose(random, 1.0)});
  const BodyTree tree(bodies);
  int touching = 0, overlaps = 0, total = 0;
  const long before = test::allocations;
  for (const Shape& shape : shapes) {
    for (int round = 0; round < 30; ++round) {
      const Eigen::Isometry3d pose = test::randomPose(random, 6.0);
      touching += tree.collides(shape, pose).status == Contact::Touching ? 1 : 0;
      const BodyTree::Nearest nearest = tree.nearest(shape, pose);
      EXPECT_LE(nearest.lower, nearest.upper);
      const Aabb box{pose.translation() - Vector3d::Ones(), pose.translation() + Vector3d::Ones()};
      tree.forEachOverlap(box, [&](const BodyTree::Body&) {
        ++overlaps;
        return false;
      });
      ++total;
    }
    ASSERT_EQ(test::allocations, before) << "kind " << shape.index();
  }
  EXPECT_GT(touching, total / 5);
  EXPECT_LT(touching, total * 9 / 10);
  EXPECT_GT(overlaps, total);
}

TEST(Impact, AllocatesNothing) {
  std::mt19937 random(5);
  const auto path = [&] {
    const Vector3d start = test::uniformPoint(random, 1.0);
    return LinearPath{start, test::uniformPoint(random, 1.0)};
  };
  int hits = 0, total = 0;
  const long before = test::allocations;
  for (int round = 0; round < 2000; ++round) {
    const std::array<LinearPath, 3> face{path(), path(), path()};
    const std::array<LinearPath, 2> first{path(), path()}, second{path(), path()};
    ImpactOptions options;
    options.separation = round % 3 == 0 ? 0.1 : 0.0;
    for (const Impact& found :
         {vertexFaceImpact(path(), face, options), edgeEdgeImpact(first, second, options)}) {
      hits += found.verdict == Verdict::Collision ? 1 : 0;
      ++total;
    }
  }
  EXPECT_EQ(test::allocations, before);
  EXPECT_GT(hits, total / 10);
  EXPECT_LT(hits, total * 9 / 10);
}

template <typename BV>
class Traversals : public testing::Test {};
TYPED_TEST_SUITE(Traversals, test::AllVolumes);

/// Once the result has room for the pairs.
TYPED_TEST(Traversals, AllocateNothing) {
  std::mt19937 random(6);
  const auto modelOf = [](const test::Soup& soup) {
    BvhModel<TypeParam> model;
    model.begin(soup.vertices.size(), soup.triangles.size());
    model.addMesh(soup.vertices, soup.triangles);
    model.end();
    return model;
  };
  const auto a = modelOf(test::blobSoup(random, 10, 12));
  test::Soup crumpled = test::torusSoup(16, 10, 0.5, 0.45);
  for (Vector3d& v : crumpled.vertices) v += test::uniformPoint(random, 0.06);
  const auto b = modelOf(crumpled);
  const std::vector<Shape> shapes = everyKind();
  MeshCollisionResult result;
  result.pairs.reserve(1 << 16);
  int touching = 0, total = 0;
  std::size_t selfPairs = 0;
  const long before = test::allocations;
  for (int round = 0; round < 40; ++round) {
    const Eigen::Isometry3d pose = test::randomPose(random, 1.7);
    for (const std::size_t most : {std::size_t{1}, result.pairs.capacity()}) {
      collideMeshes(a, b, pose, {most}, result);
      touching += result.touching ? 1 : 0;
      ++total;
      selfCollideMesh(b, {most}, result);
      selfPairs = std::max(selfPairs, result.pairs.size());
    }
    EXPECT_GE(meshDistance(a, b, pose).upper, 0.0);
    // A mesh or a cloud is no one convex body.
    const Shape& shape = shapes[static_cast<std::size_t>(round) % 10];
    collideMeshShape(a, shape, pose);
    meshShapeDistance(a, shape, pose);
  }
  EXPECT_EQ(test::allocations, before);
  EXPECT_GT(touching, total / 5);
  EXPECT_LT(touching, total * 9 / 10);
  EXPECT_GT(selfPairs, 10U);
}

/// As many closed components about the point as are promised.
TEST(TriangleMesh, EnclosesAllocatesNothing) {
  test::Soup nested;
  for (int i = 1; i <= 64; ++i) {
    nested.append(test::boxSoup(Vector3d::Constant(-0.01 * i), Vector3d::Constant(0.01 * i)));
  }
  const TriangleMesh mesh = TriangleMesh::build(nested.vertices, nested.triangles);
  ASSERT_EQ(mesh.report().closedComponents, 64);
  std::mt19937 random(7);
  int inside = 0, total = 0;
  const long before = test::allocations;
  EXPECT_TRUE(mesh.encloses(Vector3d(0.001, 0.002, 0.003)));
  for (; total < 1000; ++total) {
    inside += mesh.encloses(test::uniformPoint(random, 0.8)) ? 1 : 0;
  }
  EXPECT_EQ(test::allocations, before);
  EXPECT_GT(inside, total / 10);
  EXPECT_LT(inside, total * 9 / 10);
}

}  // namespace
}  // namespace swept
