// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/enclosing_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "mesh_samples.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace {

using namespace swept;
using namespace swept::test;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr EnclosingKind kKinds[] = {EnclosingKind::Capsule, EnclosingKind::Box,
                                    EnclosingKind::Convex};

TriangleMesh solidOf(const Soup& soup) {
  return TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Solid);
}

PosedShape standing(Shape shape, const Vector3d& place) {
  return {std::move(shape), Isometry3d(Eigen::Translation3d(place))};
}

/// A cross of two boxes, a torus, a bumpy solid, primitives.
std::vector<std::vector<PosedShape>> solids(std::mt19937& random) {
  return {{standing(solidOf(boxSoup({0, 0, 0}, {1.0, 0.2, 0.2})), {0, 0, 0}),
           {solidOf(boxSoup({0, 0, 0}, {0.2, 0.9, 0.2})), randomPose(random, 0.3)}},
          {{solidOf(torusSoup(24, 12, 0.5, 0.1)), randomPose(random, 2.0)}},
          {{solidOf(blobSoup(random, 9, 14)), randomPose(random, 1.0)}},
          {standing(Cylinder{0.1, 0.3}, {0, 0, 0.3}), standing(Box{{0.2, 0.1, 0.05}}, {0.1, 0, 0}),
           standing(Capsule{0.05, 0.2}, {0, 0.3, 0})}};
}

/// In the shape as it would be read in single precision, by means that the search does not use.
bool isIn(const PosedShape& posed, const Vector3d& p) {
  const Isometry3d pose(posed.body_from_shape.matrix().cast<float>().cast<double>());
  const Vector3d at = pose.linear().transpose() * (p - pose.translation());
  if (const auto* box = std::get_if<Box>(&posed.shape)) {
    const Vector3d half = box->halfExtents.cast<float>().cast<double>();
    return (at.cwiseAbs().array() <= half.array()).all();
  }
  if (const auto* capsule = std::get_if<Capsule>(&posed.shape)) {
    const double end = static_cast<float>(capsule->halfLength);
    return std::hypot(at.x(), at.y(), at.z() - std::clamp(at.z(), -end, end)) <=
           static_cast<float>(capsule->radius);
  }
  const auto& hull = std::get<ConvexHull>(posed.shape);
  return std::ranges::all_of(hull.faces(), [&](const Eigen::Vector3i& t) {
    const auto corner = [&](int k) {
      return hull.vertices()[static_cast<std::size_t>(t[k])].cast<float>().cast<double>().eval();
    };
    return (corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(p - corner(0)) <= 0.0;
  });
}

/// A point of the closed solid: of its surface, or between two of them on the same side of a convex
/// part.
Vector3d pointIn(const PosedShape& posed, std::mt19937& random) {
  Vector3d p = Vector3d::Zero();
  if (const auto* mesh = std::get_if<TriangleMesh>(&posed.shape)) {
    const auto last = static_cast<double>(mesh->triangles().size());
    const Eigen::Vector3i& t =
        mesh->triangles()[static_cast<std::size_t>(uniform(random, 0.0, last))];
    const double u = std::sqrt(uniform(random, 0.0, 1.0));
    const double v = uniform(random, 0.0, 1.0);
    p = (1 - u) * mesh->vertices()[t[0]] + u * (1 - v) * mesh->vertices()[t[1]] +
        u * v * mesh->vertices()[t[2]];
  } else if (const auto* box = std::get_if<Box>(&posed.shape)) {
    for (int i = 0; i < 3; ++i) p[i] = uniform(random, -1.0, 1.0) * box->halfExtents[i];
  } else if (const auto* capsule = std::get_if<Capsule>(&posed.shape)) {
    p = capsule->radius * unitVector(random);
    p.z() += uniform(random, -1.0, 1.0) * capsule->halfLength;
  } else {
    const Cylinder& cylinder = std::get<Cylinder>(posed.shape);
    const double angle = uniform(random, 0.0, 6.3);
    p = {cylinder.radius * std::cos(angle), cylinder.radius * std::sin(angle),
         uniform(random, -1.0, 1.0) * cylinder.halfLength};
  }
  return posed.body_from_shape * p;
}

double distanceFrom(const std::vector<PosedShape>& body, const Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const PosedShape& posed : body) {
    const Isometry3d shape_from_point =
        posed.body_from_shape.inverse() * Isometry3d(Eigen::Translation3d(p));
    least = std::min(least, distance(posed.shape, Sphere{0.0}, shape_from_point).upper);
  }
  return least;
}

TEST(EnclosingShapes, ContainTheBody) {
  std::mt19937 random(1);
  for (const auto& body : solids(random))
    for (const EnclosingKind kind : kKinds) {
      EnclosingShapesSearch search(body, kind, {.pieces = 60});
      for (const int count : {1, 3, 9}) {
        const EnclosingShapes found = search.atMost(count);
        ASSERT_FALSE(found.shapes.empty());
        EXPECT_LE(static_cast<int>(found.shapes.size()), count);
        for (int i = 0; i < 4000; ++i) {
          const PosedShape& posed = body[static_cast<std::size_t>(
              uniform(random, 0.0, static_cast<double>(body.size())))];
          const Vector3d p = pointIn(posed, random);
          ASSERT_TRUE(std::ranges::any_of(found.shapes,
                                          [&](const PosedShape& shape) { return isIn(shape, p); }))
              << "kind " << static_cast<int>(kind) << ", " << count << " shapes, " << p.transpose();
        }
        const OutsideSpheres judged = outsideShapes(body, found.shapes, {.mostSplits = 3000});
        EXPECT_LE(judged.lower, 0.0);
        EXPECT_LE(judged.upper, 5e-3);  // what a polyhedron around a round shape is off by
        EXPECT_EQ(judged.surfaceShare, 0.0);
      }
    }
}

TEST(EnclosingShapes, AreExactForShapesOfTheirKind) {
  std::mt19937 random(2);
  const Isometry3d pose = randomPose(random, 0.5);
  const std::vector<PosedShape> box{{Box{{0.3, 0.2, 0.1}}, pose}};
  const EnclosingShapes boxes = EnclosingShapesSearch(box, EnclosingKind::Box).atMost(1);
  ASSERT_EQ(boxes.shapes.size(), 1u);
  EXPECT_LT(shapesExcess(box, boxes.shapes).largestSeen, 1e-4);
  EXPECT_LT(shapesExcess(box, boxes.shapes).largest, 0.02);
  const EnclosingShapes hulls = EnclosingShapesSearch(box, EnclosingKind::Convex).atMost(1);
  EXPECT_LT(shapesExcess(box, hulls.shapes).largestSeen, 1e-4);
  const std::vector<PosedShape> capsule{{Capsule{0.1, 0.4}, pose}};
  const EnclosingShapes capsules = EnclosingShapesSearch(capsule, EnclosingKind::Capsule).atMost(1);
  EXPECT_LT(shapesExcess(capsule, capsules.shapes).largestSeen, 0.03);  // of a polyhedron around it
  // A sphere would reach farther than 0.3 m.
  EXPECT_GT(sphereExcess(capsule, EnclosingSpheresSearch(capsule).atMost(1).spheres).largest, 0.3);
}

TEST(EnclosingShapes, ReachAsFarAsIsSaid) {
  std::mt19937 random(3);
  for (const auto& body : solids(random))
    for (const EnclosingKind kind : kKinds) {
      EnclosingShapesSearch search(body, kind, {.pieces = 60});
      const EnclosingShapes few = search.within(0.2);
      const SphereExcess excess = shapesExcess(body, few.shapes, 0.0, {.samples = 2000});
      EXPECT_LE(excess.largest, 0.2)
          << "kind " << static_cast<int>(kind) << " seen " << excess.largestSeen << " n "
          << few.shapes.size() << " reach " << few.reach;
      EXPECT_LE(excess.largestSeen, excess.largest);
      EXPECT_LE(excess.mean, excess.largest);
      EXPECT_GE(excess.volumeRatio, 0.98);
      // Corners of boxes are points of the surface, unless another shape contains them.
      for (const PosedShape& posed : few.shapes) {
        const auto* box = std::get_if<Box>(&posed.shape);
        if (box == nullptr || few.shapes.size() > 1) continue;
        for (const double x : {-1.0, 1.0})
          for (const double y : {-1.0, 1.0})
            for (const double z : {-1.0, 1.0}) {
              const Vector3d corner =
                  posed.body_from_shape * box->halfExtents.cwiseProduct(Vector3d(x, y, z));
              EXPECT_LE(distanceFrom(body, corner), excess.largest + 1e-9);
            }
      }
      EXPECT_LE(search.countFor(0.4), search.countFor(0.1));
      EXPECT_LE(search.reachFor(8), search.reachFor(2));
    }
}

/// What is outside by a known amount.
TEST(EnclosingShapes, AreJudged) {
  const std::vector<PosedShape> body{standing(Box{{0.3, 0.2, 0.1}}, {0.1, 0, 0})};
  const std::vector<PosedShape> shift{standing(Box{{0.3, 0.2, 0.1}}, {0.1, 0.05, 0})};
  const OutsideSpheres box = outsideShapes(body, shift);
  EXPECT_NEAR(box.lower, 0.05, 1e-9);
  EXPECT_NEAR(box.upper, 0.05, 2e-5);
  EXPECT_NEAR(box.point.y(), -0.2, 1e-9);
  const std::vector<PosedShape> capsule{standing(Capsule{0.2, 0.3}, {0.1, 0, 0})};
  EXPECT_NEAR(outsideShapes(body, capsule).upper, std::hypot(0.3, 0.2) - 0.2, 2e-5);
  const std::vector<PosedShape> cylinder{standing(Cylinder{0.3, 0.3}, {0.1, 0, 0})};
  EXPECT_NEAR(outsideShapes(body, cylinder).upper, std::hypot(0.3, 0.2) - 0.3, 2e-5);
  // A hull, and the same as a mesh whose inside is not asked for.
  const Soup soup = boxSoup({-0.2, -0.2, -0.1}, {0.35, 0.2, 0.1});
  const std::vector<PosedShape> hull{{ConvexHull::of(soup.vertices)}};
  EXPECT_NEAR(outsideShapes(body, hull).upper, 0.05, 2e-5);
  const std::vector<PosedShape> mesh{{solidOf(soup)}};
  EXPECT_NEAR(outsideShapes(body, mesh).upper, 0.05, 2e-5);
  // Grown by that, it contains the body; each face moves.
  EXPECT_NEAR(shapesExcess(body, hull, 0.05).largestSeen, std::sqrt(3.0) * 0.05, 0.03);
}

TEST(EnclosingShapes, ReachToTheTipsOfAStar) {
  // A cube with a spike of 0.8 m on each face: seen whole from its middle, and not convex.
  std::vector<Vector3d> vertices;
  for (int k = 0; k < 8; ++k)
    vertices.emplace_back(0.2 * Vector3d((k & 1) != 0 ? 1.0 : -1.0, (k & 2) != 0 ? 1.0 : -1.0,
                                         (k & 4) != 0 ? 1.0 : -1.0));
  std::vector<Eigen::Vector3i> triangles;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1}) {
      const int tip = static_cast<int>(vertices.size());
      vertices.emplace_back((side == 1 ? 1.0 : -1.0) * Vector3d::Unit(axis));
      const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, base = side << axis;
      const std::vector<int> around{base, base | u, base | u | v, base | v};
      for (std::size_t i = 0; i < 4; ++i) {
        const int a = around[i], b = around[(i + 1) % 4];
        triangles.emplace_back(side == 1 ? a : b, side == 1 ? b : a, tip);
      }
    }
  const std::vector<PosedShape> star{
      {TriangleMesh::build(vertices, triangles, MeshInterior::Solid)}};
  const std::vector<PosedShape> body{{Sphere{0.05}}};
  EXPECT_LE(outsideShapes(body, star).upper, 0.0);
  const SphereExcess excess = shapesExcess(body, star);
  EXPECT_GE(excess.largest, 0.95);
  EXPECT_LE(excess.largest, 1.1);
}

TEST(EnclosingShapes, ContainNothingWithoutAnInside) {
  const std::vector<PosedShape> body{standing(Box{{0.1, 0.1, 0.1}}, {0, 0, 0})};
  const std::vector<Vector3d> flat{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const std::vector<PosedShape> hull{{ConvexHull::of(flat)}};
  EXPECT_GT(outsideShapes(body, hull).upper, 0.0);
  Soup open = boxSoup({-1, -1, -1}, {1, 1, 1});
  open.triangles.pop_back();
  const std::vector<PosedShape> mesh{
      {TriangleMesh::build(open.vertices, open.triangles, MeshInterior::Solid)}};
  EXPECT_GT(outsideShapes(body, mesh).upper, 0.0);
  EXPECT_THROW(outsideShapes(body, std::vector<PosedShape>{{Plane{{0, 0, 1}, 0}}}),
               std::invalid_argument);
  EXPECT_THROW(EnclosingShapesSearch({}, EnclosingKind::Box), std::invalid_argument);
  EXPECT_THROW(EnclosingShapesSearch(body, EnclosingKind::Box, {.pieces = 0}),
               std::invalid_argument);
  EnclosingShapesSearch search(body, EnclosingKind::Box);
  EXPECT_THROW(search.atMost(0), std::invalid_argument);
  EXPECT_THROW(search.within(0.0), std::invalid_argument);
}

/// Flat bodies, and one of two parts far from each other.
TEST(EnclosingShapes, ContainFlatAndScatteredBodies) {
  std::mt19937 random(4);
  const Soup plate{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const std::vector<std::vector<PosedShape>> bodies{
      {{TriangleMesh::build(plate.vertices, plate.triangles, MeshInterior::Surface),
        randomPose(random, 1.0)}},
      {standing(Box{{0.1, 0.1, 0.1}}, {-5, 0, 0}), standing(Box{{0.1, 0.1, 0.1}}, {5, 0, 0})}};
  for (const auto& body : bodies)
    for (const EnclosingKind kind : kKinds)
      for (const int count : {1, 4}) {
        const EnclosingShapes found = EnclosingShapesSearch(body, kind).atMost(count);
        EXPECT_LE(outsideShapes(body, found.shapes).upper, 0.0);
      }
}

}  // namespace
