// SPDX-License-Identifier: BSD-3-Clause
#include "simd/compile/simd_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "../core/mesh_samples.hpp"
#include "certify/workspace_data.hpp"
#include "simd/kernels/obstacle_kernels.hpp"
#include "swept/core/distance.hpp"

namespace swept::detail {
namespace {

using namespace HWY_NAMESPACE;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::Soup;
using test::uniform;

Shape meshOf(const Soup& soup, MeshInterior interior = MeshInterior::Solid) {
  return TriangleMesh::build(soup.vertices, soup.triangles, interior);
}

Isometry3d placed(const Vector3d& at, double angle = 0.0) {
  Isometry3d pose(Eigen::Translation3d{at});
  pose.rotate(Eigen::AngleAxisd(angle, Vector3d(1.0, 2.0, -0.5).normalized()));
  return pose;
}

struct Scene {
  const char* name;
  Shape shape;
  Isometry3d world_from_shape = Isometry3d::Identity();
  double reach = 1.5;  ///< m
  bool solid = false;  ///< encloses more than thin sheets
};

Shape nested() {
  std::mt19937 random(5);
  Soup soup = test::torusSoup(24, 12, 0.4, 0.12);
  soup.append(test::boxSoup(Vector3d(-0.1, -0.1, -0.4), Vector3d(0.1, 0.1, 0.4)));
  soup.append(test::boxSoup(Vector3d(-0.03, -0.03, -0.2), Vector3d(0.03, 0.03, 0.2)).inverted());
  return meshOf(soup);
}

Shape sliverFan() {
  std::mt19937 random(6);
  Soup soup;
  for (int i = 0; i < 40; ++i) {
    const int first = static_cast<int>(soup.vertices.size());
    const Vector3d from = test::uniformPoint(random, 0.5);
    const Vector3d along = test::unitVector(random);
    soup.vertices.insert(
        soup.vertices.end(),
        {from, from + along, from + 0.5 * along + 1e-5 * test::unitVector(random)});
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return meshOf(soup);
}

/// Sheets 1 mm apart, and one far larger than anything reaches.
Shape sheets() {
  Soup soup;
  for (const double z : {0.0, 0.001, 0.3}) {
    const int first = static_cast<int>(soup.vertices.size());
    const double size = z > 0.1 ? 500.0 : 0.4;
    for (const Vector3d& corner :
         {Vector3d(-size, -size, z), Vector3d(size, -size, z), Vector3d(0.1, size, z + 0.02)})
      soup.vertices.push_back(corner);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return meshOf(soup);
}

Shape cloud(double radius) {
  std::mt19937 random(7);
  std::vector<Vector3d> points;
  std::vector<double> radii;
  for (int i = 0; i < 3000; ++i) {
    points.push_back(0.5 * test::unitVector(random));
    radii.push_back(i % 3 == 0 ? 0.5 * radius : radius);
  }
  return PointCloud::build(points, radii);
}

std::vector<Scene> scenes() {
  std::mt19937 random(8);
  const Soup blob = test::blobSoup(random, 24, 30);
  const Soup box = test::boxSoup(Vector3d(-0.3, -0.2, -0.0005), Vector3d(0.3, 0.2, 0.0005));
  Soup open = test::torusSoup(24, 12, 0.4, 0.12);
  open.triangles.resize(open.triangles.size() / 2);
  return {
      {"blob", meshOf(blob), placed({0.3, 0.2, 0.1}, 0.7), 1.5, true},
      {"cut", meshOf(blob), placed({0.3, 0.2, 0.1}, 0.7), 0.6, true},
      {"nested", nested(), placed({0.1, 0.0, 0.3}, -0.4), 1.5, true},
      {"plate", meshOf(box), placed({0.2, -0.1, 0.1}, 0.3)},
      {"open", meshOf(open), placed({0.0, 0.1, 0.2}, 1.1)},
      {"surface", meshOf(blob, MeshInterior::Surface), placed({0.0, 0.1, 0.2}, 1.1)},
      {"slivers", sliverFan(), placed({0.0, 0.0, 0.0}, 0.1)},
      {"sheets", sheets(), placed({0.0, 0.0, 0.1}, 0.2)},
      {"points", cloud(0.0), placed({0.1, 0.2, 0.3}, 0.5)},
      {"balls", cloud(0.02), placed({0.1, 0.2, 0.3}, 0.5)},
      {"far", meshOf(blob), placed({1000.0, -700.0, 200.0}, 0.7), 1500.0, true},
      {"offset", meshOf(blob.moved(placed({600.0, 800.0, -300.0}))),
       placed({-600.0, -800.0, 300.0}), 1.5, true},
  };
}

WorldGeometry worldGeometry(const Shape& shape, const Isometry3d& world_from_shape) {
  WorldGeometry geometry;
  geometry.shape = shape;
  geometry.world_from_shape = world_from_shape;
  const Aabb box = boundingBox(shape);
  Isometry3d world_from_box = world_from_shape;
  world_from_box.translation() = world_from_shape * box.center();
  geometry.box_from_world = world_from_box.inverse();
  geometry.halfExtents = box.upper - box.center();
  geometry.magnitude = world_from_box.translation().norm() + geometry.halfExtents.norm();
  return geometry;
}

SimdObstacles compiled(const Shape& shape, const Isometry3d& pose, double reach) {
  return compileObstacles({worldGeometry(shape, pose)}, reach, true);
}

DistanceResult exactly(const Shape& shape, const Isometry3d& world_from_shape, const Vector3d& p) {
  const Isometry3d point_from_world(Eigen::Translation3d{-p});
  return distance(Sphere{0.0}, shape, point_from_world * world_from_shape);
}

/// Points all around, near the surface, inside, at corners and faces of cells, and beyond the grid.
Vector3d samplePoint(const Scene& scene, const SimdField& field, std::mt19937& random) {
  const Isometry3d world_from_grid =
      scene.world_from_shape * Eigen::Translation3d(field.field->origin);
  const double side = static_cast<double>(field.field->voxel);
  const auto [nx, ny, nz] = field.field->blocks;
  const Vector3d size = 4.0 * side * Vector3d(nx, ny, nz);
  Vector3d point(uniform(random, 0.0, size.x()), uniform(random, 0.0, size.y()),
                 uniform(random, 0.0, size.z()));
  switch (random() % 4) {
    case 0:  // borders of voxels and cells
      for (int i = 0; i < 3; ++i)
        if (random() % 2 != 0) point[i] = side * std::round(point[i] / side);
      break;
    case 1:
      point = 0.5 * size + 1.2 * (point - 0.5 * size);
      break;
    case 2: {  // towards the shape, to about a voxel
      const Isometry3d grid_from_shape = world_from_grid.inverse() * scene.world_from_shape;
      const DistanceResult found = exactly(scene.shape, grid_from_shape, point);
      if (found.upper > 0.0) {
        const double step = found.upper - uniform(random, -1.0, 4.0) * side;
        point += step / found.upper * found.pointB;
      }
      break;
    }
    default:
      break;
  }
  return world_from_grid * point;
}

V3 inLanes(const Vector3d& p) {
  const float at[3] = {static_cast<float>(p.x()), static_cast<float>(p.y()),
                       static_cast<float>(p.z())};
  return set3(at);
}

Vector3d rounded(const Vector3d& p) {
  return p.cast<float>().cast<double>();
}

TEST(ClearanceField, NeverSaysMoreThanTheDistance) {
  for (const Scene& scene : scenes()) {
    SCOPED_TRACE(scene.name);
    const SimdObstacles lanes = compiled(scene.shape, scene.world_from_shape, scene.reach);
    ASSERT_EQ(lanes.obstacles.at(0).kind, ObstacleKind::Field);
    const SimdField& field = lanes.fields.at(0);
    std::mt19937 random(1);
    int positive = 0;
    int contained = 0;
    int beside = 0;
    for (int i = 0; i < 12000 && positive < 1200; ++i) {
      const Vector3d p = rounded(samplePoint(scene, field, random));
      if (p.norm() > scene.reach) continue;
      const double upper = exactly(scene.shape, scene.world_from_shape, p).upper;
      const V3 at = inFrame(field, inLanes(p), true);
      // Without bricks, and with them.
      for (const float enough : {-1e9F, 1e9F}) {
        const auto bound = static_cast<double>(largestLane(clearance(field, at, set(enough), 1)));
        ASSERT_LE(bound, upper) << p.transpose();
        if (enough > 0.0F) positive += bound > 0.0;
      }
      contained += upper == 0.0;
      beside += upper > 0.0 && upper < 2.0 * static_cast<double>(field.cell);
    }
    EXPECT_GT(positive, 200);
    EXPECT_GT(beside, 200);
    if (scene.solid) {
      EXPECT_GT(contained, 50);
    }
  }
}

/// In the grid: a marked cell reaches at most sqrt(3) beyond what is in it, and the middle of a
/// cell is half that away; for voxels near the shape half as much of each. Values are rounded down.
TEST(ClearanceField, SaysNotMuchLess) {
  for (const Scene& scene : scenes()) {
    const std::string name = scene.name;
    if (name == "cut" || name == "sheets") continue;  // what is beyond the grid counts
    SCOPED_TRACE(name);
    const double most = 2.0 * std::numbers::sqrt3 + (name == "slivers" ? 1.1 : 0.1);  // cells
    const SimdObstacles lanes = compiled(scene.shape, scene.world_from_shape, scene.reach);
    const SimdField& field = lanes.fields.at(0);
    const auto cell = static_cast<double>(field.cell);
    const auto slack = static_cast<double>(field.slack);
    std::mt19937 random(2);
    int near = 0;
    int all = 0;
    int good = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vector3d p = rounded(samplePoint(scene, field, random));
      const double lower = exactly(scene.shape, scene.world_from_shape, p).lower;
      const V3 at = inFrame(field, inLanes(p), true);
      const V3 beyond = {smaller(larger(at.x, set(field.lower[0])), set(field.upper[0])) - at.x,
                         smaller(larger(at.y, set(field.lower[1])), set(field.upper[1])) - at.y,
                         smaller(larger(at.z, set(field.lower[2])), set(field.upper[2])) - at.z};
      if (largestLane(dot(beyond, beyond)) > 0.0F) continue;
      const auto bound = static_cast<double>(largestLane(clearance(field, at, set(1e9F), 1)));
      if (!(lower > 0.0) || lower > 15.0 * cell) continue;
      ++all;
      good += bound >= 0.5 * lower - cell - 2.0 * slack;
      ASSERT_GE(bound, lower - most * cell - 2.0 * slack);
      if (lower > cell) continue;
      ++near;
      ASSERT_GE(bound, lower - 0.5 * most * cell - 2.0 * slack);
    }
    EXPECT_GT(near, 200);
    EXPECT_GE(good, all * 98 / 100);
  }
}

TEST(ClearanceField, ProvesOnlySegmentsThatAreApart) {
  int proven = 0;
  int queried = 0;
  for (const Scene& scene : scenes()) {
    SCOPED_TRACE(scene.name);
    const SimdObstacles lanes = compiled(scene.shape, scene.world_from_shape, scene.reach);
    const SimdField& field = lanes.fields.at(0);
    std::mt19937 random(3);
    for (int i = 0; i < 1500; ++i) {
      const Vector3d p = rounded(samplePoint(scene, field, random));
      if (p.norm() > scene.reach) continue;
      const double length = std::exp(uniform(random, std::log(1e-3), std::log(0.3)));
      const Vector3d g = rounded(length * test::unitVector(random));
      double least = 1e9;
      double lower = 1e9;
      for (int k = -6; k <= 6; ++k) {
        const DistanceResult found = exactly(scene.shape, scene.world_from_shape, p + k / 6.0 * g);
        least = std::min(least, found.upper);
        lower = std::min(lower, found.lower);
      }
      // Near to what is true: most of these could be proven, or could not quite.
      const auto radius = static_cast<float>(std::max(least * uniform(random, 0.3, 1.1), 1e-3));
      const FieldAnswer answer = askField(field, {inLanes(p), inLanes(g)}, set(radius), kAllLanes);
      MovingPoint point;
      for (int k = 0; k < 3; ++k) {
        point.x[k] = static_cast<float>(p[k]);
        point.g[k] = static_cast<float>(g[k]);
      }
      const bool apart = isApart(field, point, radius, false);
      if (answer.apart != 0 || apart) {
        ASSERT_GT(least, static_cast<double>(radius)) << i;
      }
      proven += answer.apart != 0;
      queried += apart && answer.apart == 0;
      const bool near = reaches(field, point, radius, false);
      const DistanceResult middle = exactly(scene.shape, scene.world_from_shape, p);
      if (near) {
        ASSERT_LE(middle.lower, static_cast<double>(radius));
      }
      if (middle.upper < 0.99 * static_cast<double>(radius)) {
        ASSERT_TRUE(near);
      }
    }
  }
  EXPECT_GT(proven, 3000);
  EXPECT_GT(queried, 1000);
}

TEST(ClearanceField, IsSharedAndRepeatable) {
  std::mt19937 random(9);
  const Shape shape = meshOf(test::blobSoup(random, 10, 12));
  const std::vector<WorldGeometry> world = {
      worldGeometry(shape, placed({0.5, 0.0, 0.0})),
      worldGeometry(shape, placed({0.0, 0.5, 0.1}, 2.0)),
  };
  const SimdObstacles lanes = compileObstacles(world, 5.0, true);
  const SimdObstacles again = compileObstacles(world, 5.0, true);
  ASSERT_EQ(lanes.fields.size(), 2u);
  EXPECT_EQ(lanes.fields[0].field, lanes.fields[1].field);
  EXPECT_NE(lanes.fields[0].field, again.fields[0].field);
  EXPECT_EQ(lanes.fields[0].field->cells, again.fields[0].field->cells);
  EXPECT_EQ(lanes.fields[0].field->bricks, again.fields[0].field->bricks);
  EXPECT_EQ(lanes.fields[0].field->voxels, again.fields[0].field->voxels);
}

TEST(ClearanceField, ManyBodiesStayWithinABudget) {
  std::mt19937 random(10);
  std::vector<WorldGeometry> world;
  for (int i = 0; i < 100; ++i)
    world.push_back(worldGeometry(meshOf(test::blobSoup(random, 6, 8)),
                                  placed(2.0 * test::uniformPoint(random, 1.0), i)));
  std::size_t bytes = 0;
  for (const SimdField& field : compileObstacles(world, 4.0, true).fields)
    bytes += field.field->bytes();
  EXPECT_LT(bytes, std::size_t{40} << 20);
}

TEST(ClearanceField, NoNumberIsNeverApart) {
  const Scene scene = scenes().front();
  const SimdObstacles lanes = compiled(scene.shape, scene.world_from_shape, scene.reach);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (int i = 0; i < 6; ++i) {
      Vector3d x(1.2, 1.2, 1.2);
      Vector3d g(0.01, 0.01, 0.01);
      (i < 3 ? x : g)[i % 3] = bad;
      const FieldAnswer answer =
          askField(lanes.fields.at(0), {inLanes(x), inLanes(g)}, set(0.01F), kAllLanes);
      if (std::isnan(bad) || i >= 3) {
        EXPECT_EQ(answer.apart, 0u) << bad << " " << i;
      }
    }
  }
}

TEST(SimdObstacles, EllipsoidsAndTrianglesAreNoNearerThanTheyAre) {
  std::mt19937 random(11);
  double worst = 0.0;
  int all = 0;
  for (int i = 0; i < 4000; ++i) {
    Shape shape = Ellipsoid{{uniform(random, 0.05, 0.5), uniform(random, 0.05, 0.5),
                             i % 10 == 0 ? 0.0 : uniform(random, 0.05, 0.5)}};
    const bool triangle = i % 2 != 0;
    if (triangle)
      shape = Triangle{{test::uniformPoint(random, 0.4), test::uniformPoint(random, 0.4),
                        test::uniformPoint(random, i % 10 == 1 ? 1e-9 : 0.4)}};
    const Isometry3d pose = test::randomPose(random, 0.5);
    const SimdObstacles lanes = compiled(shape, pose, 2.0);
    ASSERT_NE(lanes.obstacles.at(0).near, NearProof::Distance);
    const Vector3d p = rounded(test::uniformPoint(random, 1.0));
    const Vector3d g = i % 3 == 0 ? Vector3d::Zero()
                                  : rounded(uniform(random, 0.0, 0.3) * test::unitVector(random));
    DistanceResult least = exactly(shape, pose, p);
    for (int k = -8; k <= 8; ++k) {
      const DistanceResult found = exactly(shape, pose, p + k / 8.0 * g);
      if (found.upper < least.upper) least = found;
    }
    const Segment segment = {inLanes(p), inLanes(g)};
    const double bound = std::sqrt(
        static_cast<double>(largestLane(squaredDistance(lanes, lanes.obstacles[0], segment))));
    ASSERT_LE(bound, least.upper) << i;
    if (triangle) continue;
    ++all;
    if (g.isZero() && least.lower > 0.05 && i % 10 != 0)
      worst = std::max(worst, (least.lower - bound) / least.lower);
    // Inside means inside.
    if (g.isZero() && bound == 0.0) {
      EXPECT_LT(least.lower, 1e-4);
    }
  }
  EXPECT_GT(all, 1000);
  EXPECT_LT(worst, 0.5);
}

}  // namespace
}  // namespace swept::detail
