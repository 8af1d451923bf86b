// SPDX-License-Identifier: BSD-3-Clause
// Meshes, hierarchies and broadphases, whose queries are templates that a program compiles itself,
// are the same, bit for bit, in every floating-point environment; so is what they call.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "all_volumes.hpp"
#include "bvh_models.hpp"
#include "mesh_samples.hpp"
#include "swept/core/broadphase/body_tree.hpp"
#include "swept/core/broadphase/brute_force.hpp"
#include "swept/core/broadphase/sweep_and_prune.hpp"
#include "swept/core/bvh/split_rules.hpp"
#include "swept/core/continuous/deforming_mesh.hpp"
#include "swept/core/traversal/mesh_collision.hpp"
#include "swept/core/traversal/mesh_distance.hpp"
#include "swept/core/traversal/mesh_self_collision.hpp"
#include "swept/core/traversal/mesh_shape.hpp"
#include "swept/core/triangle_mesh.hpp"
#include "transcript.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::expectSameInEveryEnvironment;
using test::modelOf;
using test::Query;
using test::Soup;
using test::Transcript;

/// A sheet of bumps of about that size. Of small ones a few: where squares are denormal, nothing is
/// left out.
Soup sheet(unsigned seed, double size) {
  std::mt19937 random(seed);
  const int side = size < 1.0 ? 4 : 7;
  Soup soup;
  for (int i = 0; i < side; ++i) {
    for (int k = 0; k < side; ++k) {
      soup.vertices.push_back(size * (Vector3d(i, k, 0.0) / 5.0 + test::uniformPoint(random, 0.1)));
      if (i == 0 || k == 0) continue;
      const int at = i * side + k;
      soup.triangles.emplace_back(at, at - 1, at - side);
      soup.triangles.emplace_back(at - 1, at - side - 1, at - side);
    }
  }
  return soup;
}

constexpr std::array kSizes{1.0, 1e-155, 3e-309};

std::string nameOf(double size) {
  return "size " + std::to_string(std::log10(size));
}

void tell(Transcript& answers, const MeshCollisionResult& result) {
  answers.add(result.touching, result.effort.bvTests, result.effort.leafTests);
  for (const TrianglePair& pair : result.pairs) answers.add(pair.first, pair.second);
}
void tell(Transcript& answers, const MeshDistanceResult& d) {
  answers.add(d.lower, d.upper, d.pointA, d.pointB, d.triangleA, d.triangleB, d.effort.bvTests);
}
template <typename BV>
void tell(Transcript& answers, const BV& volume, const BV& other, const Isometry3d& pose) {
  answers.add(volume.overlaps(other, pose), volume.distanceBound(other, pose));
}

template <typename BV>
class EnvironmentOfVolumes : public testing::Test {};
TYPED_TEST_SUITE(EnvironmentOfVolumes, test::AllVolumes);

TYPED_TEST(EnvironmentOfVolumes, IsTheDefault) {
  std::vector<Query> queries;
  std::mt19937 random(2);
  for (const double size : kSizes) {
    std::vector<Soup> soups;
    std::vector<Isometry3d> poses;
    const double third = size / 3.0;
    for (unsigned i = 0; i < 12; ++i) {
      soups.push_back(sheet(i, size));
      poses.push_back(test::randomPose(random, 2.0 * size));
    }
    queries.push_back(
        {nameOf(size), [=](Transcript& t) {
           for (std::size_t i = 0; i < soups.size(); ++i) {
             const auto a = TypeParam::fit(soups[i].vertices);
             const auto b = TypeParam::fit(std::span(soups[11 - i].vertices).first(4));
             tell(t, a, b, poses[i]);
             tell(t, TypeParam::merge(a, b), a.inflated(third), poses[i]);
             // Comparisons of numbers that are denormal are those of who compares.
             if (size > 1e-300)
               t.add(a.overlaps(b.inflated(third)), a.contains(poses[i].translation()));
           }
         }});
  }
  expectSameInEveryEnvironment(queries);
}

TYPED_TEST(EnvironmentOfVolumes, IsTheDefaultForModels) {
  std::vector<Query> queries;
  for (const double size : kSizes) {
    const Soup first = sheet(3, size), second = sheet(4, size);
    const auto a = modelOf<TypeParam>(first), b = modelOf<TypeParam>(second);
    std::mt19937 random(5);
    const Isometry3d near = test::randomPose(random, 0.3 * size);
    Isometry3d far = near;
    far.translation().z() += 3.0 * size;
    const double third = size / 3.0;
    queries.push_back({nameOf(size), [=](Transcript& t) {
                         FrontList front;
                         for (const Isometry3d& pose : {near, far, near}) {
                           MeshCollisionResult result;
                           collideMeshes(a, b, pose, {.maxPairs = 50}, result);
                           tell(t, result);
                           collideMeshes(a, b, pose, {.maxPairs = 50}, result, &front);
                           tell(t, result);
                           tell(t, meshDistance(a, b, pose));
                           const Shape box = Box{Vector3d::Constant(third)};
                           t.add(collideMeshShape(a, box, pose).contact);
                           tell(t, meshShapeDistance(a, box, pose));
                         }
                         MeshCollisionResult result;
                         selfCollideMesh(a, {.maxPairs = 50}, result);
                         tell(t, result);
                       }});
    queries.push_back({nameOf(size) + " made", [=](Transcript& t) {
                         auto model = modelOf<TypeParam>(first, {.split = SurfaceAreaSplit{}});
                         model.beginUpdate();
                         model.updateVertices(0, second.vertices);
                         model.endUpdate();
                         tell(t, meshDistance(model, b, far));
                         model.beginReplace();
                         model.replaceVertices(0, second.vertices);
                         model.endReplace(Refresh::Rebuild);
                         tell(t, meshDistance(model, a, far));
                         t.add(model.extent(), model.tree().order());
                       }});
  }
  expectSameInEveryEnvironment(queries);
}

TEST(EnvironmentOfMeshes, IsTheDefaultForSplitRules) {
  std::vector<Query> queries;
  for (const double size : kSizes) {
    std::mt19937 random(6);
    std::vector<SplitItem> items;
    for (int i = 0; i < 200; ++i) {
      const Vector3d p = test::uniformPoint(random, size);
      items.push_back({p, p + size * Vector3d(0.01, 0.02, 1.0 / 30.0), i});
    }
    const auto ask = [items](const SplitFunction& rule, Transcript& t) {
      std::vector<SplitItem> parted = items;
      t.add(rule(parted));
      for (const SplitItem& item : parted) t.add(item.primitive);
    };
    queries.push_back({nameOf(size), [=](Transcript& t) {
                         ask(MeanSplit{}, t);
                         ask(MedianSplit{}, t);
                         ask(PrincipalAxisSplit{}, t);
                         ask(SurfaceAreaSplit{}, t);
                       }});
  }
  expectSameInEveryEnvironment(queries);
}

TEST(EnvironmentOfMeshes, IsTheDefaultForSolids) {
  std::vector<Query> queries;
  for (const double size : kSizes) {
    const Soup box =
        test::boxSoup(Vector3d::Constant(-size / 3.0), Vector3d(size, size, size / 7.0));
    std::vector<Vector3d> later = box.vertices;
    for (Vector3d& v : later) v *= 1.1;
    const Vector3d inner = Vector3d::Constant(size / 9.0);
    queries.push_back({nameOf(size), [=](Transcript& t) {
                         const auto mesh = TriangleMesh::build(box.vertices, box.triangles);
                         const TriangleMesh moved = mesh.moved(later);
                         for (const TriangleMesh& m : {mesh, moved}) {
                           t.add(m.vertices(), m.concavity(), m.hull().error(), m.hull().vertices(),
                                 m.convexParts().size(), m.encloses(inner));
                         }
                       }});
  }
  expectSameInEveryEnvironment(queries);
}

void tell(Transcript& t, const DeformingResult& r) {
  t.add(r.verdict, r.freeUntil, r.contactBy, r.effort.candidates, r.effort.features);
  for (const TriangleImpact& hit : r.impacts)
    t.add(hit.first, hit.second, hit.verdict, hit.freeUntil, hit.contactBy);
}

TEST(EnvironmentOfMeshes, IsTheDefaultForThoseThatDeform) {
  std::vector<Query> queries;
  for (const double size : {1.0, 1e-155}) {
    const Soup first = sheet(7, size), second = sheet(8, size);
    std::vector<Vector3d> crumpled = second.vertices;
    for (Vector3d& v : crumpled) v.z() = -v.z() + 0.3 * v.x();
    const DeformingOptions options{size / 100.0, size / 1000.0, false};
    queries.push_back({nameOf(size), [=](Transcript& t) {
                         auto a = DeformingMesh::build(first.vertices, first.triangles);
                         auto b = DeformingMesh::build(second.vertices, second.triangles);
                         a.moveTo(second.vertices, 3);
                         b.place(second.vertices);
                         b.moveTo(crumpled);
                         t.add(a.growth(), b.growth());
                         DeformingWorkspace workspace;
                         DeformingResult hits;
                         collideContinuous(a, b, options, hits, workspace);
                         tell(t, hits);
                         selfCollideContinuous(b, options, hits, workspace);
                         tell(t, hits);
                         MeshCollisionResult touching;
                         collide(a, b, {.maxPairs = 50}, touching, workspace);
                         tell(t, touching);
                         selfCollide(b, {.maxPairs = 50}, touching, workspace);
                         tell(t, touching);
                         b.rebuild();
                         t.add(b.growth());
                       }});
  }
  expectSameInEveryEnvironment(queries);
}

/// Boxes that touch but for a denormal, and others.
std::vector<Aabb> boxes() {
  std::mt19937 random(9);
  std::vector<Aabb> all;
  for (int i = 0; i < 40; ++i) {
    const Vector3d p = test::uniformPoint(random, 1.0);
    all.push_back({p, p + Vector3d::Constant(0.3)});
  }
  constexpr double kTiny = 3e-310;
  all.push_back({Vector3d::Constant(-1.0), Vector3d::Constant(kTiny)});
  all.push_back({Vector3d::Constant(2.0 * kTiny), Vector3d::Ones()});
  all.push_back({Vector3d::Constant(2.0 * kTiny), Vector3d::Constant(kTiny)});
  return all;
}

template <typename Manager>
class EnvironmentOfBroadphase : public testing::Test {};
using Managers = testing::Types<BruteForce, SweepAndPrune>;
TYPED_TEST_SUITE(EnvironmentOfBroadphase, Managers);

TYPED_TEST(EnvironmentOfBroadphase, IsTheDefault) {
  const std::vector<Aabb> all = boxes();
  const auto ask = [](const TypeParam& manager, const std::vector<Aabb>& boxes, Transcript& t) {
    BroadphaseScratch scratch;
    const auto pair = [&](BoxHandle a, BoxHandle b) { return t.add(a, b), false; };
    const auto one = [&](BoxHandle a) { return t.add(a), false; };
    int seen = 0;
    const auto near = [&](BoxHandle a, double d) { return t.add(a, d), ++seen % 5 == 0 ? d : 9.0; };
    const auto nearPair = [&](BoxHandle a, BoxHandle b, double d) {
      return t.add(a, b, d), ++seen % 50 == 0 ? d : 9.0;
    };
    manager.collide(pair);
    manager.collide(manager, scratch, pair);
    for (const Aabb& box : boxes) {
      manager.collide(box, scratch, one);
      t.add(manager.distance(box, scratch, near));
    }
    t.add(manager.distance(scratch, nearPair), manager.distance(manager, scratch, nearPair));
  };
  TypeParam there;
  there.registerBoxes(all);
  expectSameInEveryEnvironment(
      {{"asked", [=](Transcript& t) { ask(there, all, t); }},
       {"made", [=](Transcript& t) {
          TypeParam manager;
          manager.registerBoxes(all);
          manager.registerBox(all.back());
          std::vector<Aabb> moved(all.begin() + 3, all.end());
          moved.insert(moved.end(), all.begin(), all.begin() + 4);
          manager.updateAll(moved);
          manager.update(2, all[7]);
          manager.update(std::vector<BoxHandle>{0, 1}, std::span(all).first(2));
          manager.unregisterBox(3);
          for (const Aabb& box : all) {
            const Aabb taken = boundedOrEverywhere(box);
            t.add(taken.lower, taken.upper, boxDistance(box, all.front()));
          }
          ask(manager, all, t);
        }}});
}

TYPED_TEST(EnvironmentOfBroadphase, IsTheDefaultForVisitorsAlso) {
  TypeParam manager;
  manager.registerBoxes(boxes());
  const std::uint32_t usual = test::environmentBits();
  for (const test::Environment& environment : test::foreignEnvironments()) {
    SCOPED_TRACE(environment.name);
    int others = 0, visited = 0;
    EXPECT_TRUE(test::leavesAlone(environment, [&] {
      manager.collide([&](BoxHandle, BoxHandle) {
        others += test::environmentBits() != usual ? 1 : 0;
        return ++visited < 0;
      });
      EXPECT_THROW(manager.collide(
                       [](BoxHandle, BoxHandle) -> bool { throw std::runtime_error("visitor"); }),
                   std::runtime_error);
    }));
    EXPECT_GT(visited, 10);
    EXPECT_EQ(others, 0);
  }
}

TEST(EnvironmentOfMeshes, IsTheDefaultForTreesOfBodies) {
  std::mt19937 random(11);
  std::vector<BodyTree::Body> bodies;
  for (int i = 0; i < 30; ++i)
    bodies.push_back({i, Box{Vector3d::Constant(0.1)}, test::randomPose(random, 1.0)});
  std::vector<Isometry3d> poses;
  for (int i = 0; i < 20; ++i) poses.push_back(test::randomPose(random, 1.5));
  expectSameInEveryEnvironment({{"tree", [=](Transcript& t) {
                                   const BodyTree tree(bodies);
                                   const Shape shape = Capsule{0.1, 0.2};
                                   for (const Isometry3d& pose : poses) {
                                     const BodyTree::Hit hit = tree.collides(shape, pose);
                                     const BodyTree::Nearest near = tree.nearest(shape, pose);
                                     t.add(hit.status, hit.id, near.lower, near.upper, near.id,
                                           near.pointOfShape, near.pointOfBody);
                                     const Vector3d p = pose.translation();
                                     tree.forEachOverlap(Aabb{p, p}, [&](const BodyTree::Body& b) {
                                       return t.add(b.id), false;
                                     });
                                   }
                                   for (const auto& body : tree.bodies())
                                     t.add(body.world_from_body);
                                 }}});
}

}  // namespace
}  // namespace swept
