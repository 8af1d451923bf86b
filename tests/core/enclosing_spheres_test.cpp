// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/enclosing_spheres.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <stop_token>
#include <thread>
#include <vector>

#include "mesh_samples.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/enclosing_shapes.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace {

using namespace swept;
using namespace swept::test;
using Eigen::Isometry3d;
using Eigen::Vector3d;

TriangleMesh meshOf(const Soup& soup, MeshInterior interior = MeshInterior::Solid) {
  return TriangleMesh::build(soup.vertices, soup.triangles, interior);
}

PosedShape at(Shape shape, const Vector3d& place) {
  return {std::move(shape), Isometry3d(Eigen::Translation3d(place))};
}

/// Two boxes at right angles, a torus, a bumpy solid, primitives, and an open sheet.
std::vector<std::vector<PosedShape>> bodies(std::mt19937& random) {
  Soup sheet;
  for (int i = 0; i <= 12; ++i)
    for (const double z : {-0.3, 0.3})
      sheet.vertices.emplace_back(0.4 * std::cos(0.2 * i), 0.4 * std::sin(0.2 * i), z);
  for (int i = 0; i < 12; ++i) {
    sheet.triangles.emplace_back(2 * i, 2 * i + 1, 2 * i + 2);
    sheet.triangles.emplace_back(2 * i + 1, 2 * i + 3, 2 * i + 2);
  }
  return {{at(meshOf(boxSoup({0, 0, 0}, {1.0, 0.2, 0.2})), {0, 0, 0}),
           {meshOf(boxSoup({0, 0, 0}, {0.2, 0.9, 0.2})), randomPose(random, 0.3)}},
          {{meshOf(torusSoup(24, 12, 0.5, 0.1)), randomPose(random, 2.0)}},
          {{meshOf(blobSoup(random, 9, 14)), randomPose(random, 1.0)}},
          {at(Cylinder{0.1, 0.3}, {0, 0, 0.3}), at(Box{{0.2, 0.1, 0.05}}, {0.1, 0, 0}),
           at(Capsule{0.05, 0.2}, {0, 0.3, 0}), at(Sphere{0.07}, {0, -0.3, 0.1})},
          {{meshOf(sheet), randomPose(random, 1.0)}}};
}

/// A point of the surface or, of a convex combination, of the inside.
Vector3d pointOf(const PosedShape& posed, std::mt19937& random) {
  Vector3d p;
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
  } else if (const auto* sphere = std::get_if<Sphere>(&posed.shape)) {
    p = sphere->radius * unitVector(random);
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

double outside(const std::vector<EnclosingSphere>& spheres, const Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [center, radius] : spheres)
    least = std::min(least, (p - center).norm() - radius);
  return least;
}

double distanceTo(const std::vector<PosedShape>& body, const Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const PosedShape& posed : body) {
    const Isometry3d shape_from_point =
        posed.body_from_shape.inverse() * Isometry3d(Eigen::Translation3d(p));
    least = std::min(least, distance(posed.shape, Sphere{0.0}, shape_from_point).upper);
  }
  return least;
}

EnclosingSpheresOptions quick() {
  return {.pieces = 600, .restarts = 2, .rounds = 6};
}

TEST(EnclosingSpheres, ContainTheBody) {
  std::mt19937 random(1);
  for (const auto& body : bodies(random)) {
    EnclosingSpheresSearch search(body, quick());
    double before = std::numeric_limits<double>::infinity();
    for (const int count : {1, 4, 16}) {
      const EnclosingSpheres found = search.atMost(count);
      EXPECT_LE(static_cast<int>(found.spheres.size()), count);
      EXPECT_LE(found.reach, before * 1.05);
      before = found.reach;
      for (int i = 0; i < 20000; ++i) {
        const PosedShape& posed =
            body[static_cast<std::size_t>(uniform(random, 0.0, static_cast<double>(body.size())))];
        ASSERT_LE(outside(found.spheres, pointOf(posed, random)), 0.0);
      }
      const OutsideSpheres judged = outsideSpheres(body, found.spheres);
      EXPECT_LE(judged.lower, 0.0);
      EXPECT_LE(judged.upper, 2e-3);  // what a polyhedron around a round shape is off by
      EXPECT_EQ(judged.surfaceShare, 0.0);
    }
  }
}

TEST(EnclosingSpheres, ContainTheInsideOfClosedMeshes) {
  const std::vector<PosedShape> body{at(meshOf(boxSoup({0, 0, 0}, {1, 1, 1})), {0, 0, 0})};
  for (const int count : {8, 30}) {
    const EnclosingSpheres found = EnclosingSpheresSearch(body, quick()).atMost(count);
    std::mt19937 random(2);
    for (int i = 0; i < 20000; ++i) {
      const Vector3d p(uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1));
      ASSERT_LE(outside(found.spheres, p), 0.0);
    }
  }
}

TEST(EnclosingSpheres, AreAFewForAReach) {
  std::mt19937 random(3);
  for (const auto& body : bodies(random)) {
    EnclosingSpheresSearch search(body, quick());
    std::size_t more = 0;
    for (const double reach : {0.25, 0.12}) {
      const EnclosingSpheres found = search.within(reach);
      EXPECT_LE(found.reach, reach);
      EXPECT_GE(found.spheres.size(), more);
      more = found.spheres.size();
      EXPECT_LE(outsideSpheres(body, found.spheres).lower, 0.0);
      EXPECT_LE(sphereExcess(body, found.spheres).largestSeen, reach + 1e-6);
    }
  }
}

TEST(EnclosingSpheres, AreTheSameForASeed) {
  std::mt19937 random(4);
  const auto body = bodies(random).front();
  const auto a = EnclosingSpheresSearch(body, quick()).atMost(7).spheres;
  const auto b = EnclosingSpheresSearch(body, quick()).atMost(7).spheres;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].center, b[i].center);
    EXPECT_EQ(a[i].radius, b[i].radius);
    for (const double value : {a[i].center.x(), a[i].center.y(), a[i].center.z(), a[i].radius}) {
      const volatile float single = static_cast<float>(value);  // see inSinglePrecision()
      EXPECT_EQ(value, static_cast<double>(single)) << i;
    }
  }
}

/// A cube of edge 2 about the origin, whose corners are sqrt(3) away.
TEST(OutsideSpheres, IsWhatACubesCornersSay) {
  const std::vector<PosedShape> cube{at(meshOf(boxSoup({-1, -1, -1}, {1, 1, 1})), {0, 0, 0})};
  for (const double radius : {0.5, 1.2, 1.7, 1.8}) {
    const OutsideSpheres found =
        outsideSpheres(cube, std::vector<EnclosingSphere>{{{0, 0, 0}, radius}});
    EXPECT_NEAR(found.lower, std::sqrt(3.0) - radius, 1e-9);
    EXPECT_GE(found.upper, std::sqrt(3.0) - radius);
    EXPECT_LE(found.upper, std::sqrt(3.0) - radius + 1.1e-5);
    EXPECT_NEAR(found.point.norm(), std::sqrt(3.0), 1e-9);
    EXPECT_EQ(found.surfaceShare > 0.0, radius < std::sqrt(3.0));
  }
}

/// Eight balls at the corners leave the middle of a cube out, but none of its surface.
TEST(OutsideSpheres, SeesTheInsideOfSolidsAlone) {
  std::vector<EnclosingSphere> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back({{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0}, 1.5});
  const Soup soup = boxSoup({-1, -1, -1}, {1, 1, 1});
  const auto solid = outsideSpheres(std::vector{at(meshOf(soup), {0, 0, 0})}, corners);
  EXPECT_NEAR(solid.lower, std::sqrt(3.0) - 1.5, 1e-4);
  EXPECT_GE(solid.upper, std::sqrt(3.0) - 1.5);
  EXPECT_LT(solid.point.norm(), 1e-3);
  const auto surface =
      outsideSpheres(std::vector{at(meshOf(soup, MeshInterior::Surface), {0, 0, 0})}, corners);
  EXPECT_NEAR(surface.lower, std::sqrt(2.0) - 1.5, 1e-4);
  EXPECT_LE(surface.upper, 0.0);
}

TEST(OutsideSpheres, BoundsAgreeWithSamplesOfAnySpheres) {
  std::mt19937 random(5);
  int reachOut = 0;
  int cases = 0;
  for (int round = 0; round < 4; ++round)
    for (const auto& body : bodies(random)) {
      std::vector<EnclosingSphere> spheres;
      for (int i = 0; i < 6; ++i)
        spheres.push_back({pointOf(body.front(), random), uniform(random, 0.2, 0.9)});
      const OutsideSpheres found = outsideSpheres(body, spheres);
      EXPECT_LE(found.lower, found.upper);
      EXPECT_NEAR(outside(spheres, found.point), found.lower, 1e-3);
      double most = -std::numeric_limits<double>::infinity();
      for (int i = 0; i < 3000; ++i)
        for (const PosedShape& posed : body)
          most = std::max(most, outside(spheres, pointOf(posed, random)));
      EXPECT_LE(most, found.upper);
      EXPECT_GE(most, found.lower - 0.1);
      ++cases;
      if (found.lower > 0.0) ++reachOut;
      // The smallest inflation that encloses.
      for (EnclosingSphere& sphere : spheres) sphere.radius += std::max(0.0, found.upper);
      EXPECT_LE(outsideSpheres(body, spheres).lower, 1e-9);
    }
  EXPECT_GT(reachOut, cases / 5);
  EXPECT_LT(reachOut, cases);
}

/// A ball around a smaller one: its surface is the difference of the radii away everywhere.
TEST(SphereExcess, IsWhatTwoBallsSay) {
  const std::vector<PosedShape> body{at(Sphere{0.3}, {0.1, 0, 0})};
  const std::vector<EnclosingSphere> spheres{{{0.1, 0, 0}, 0.5}};
  const SphereExcess found = sphereExcess(body, spheres);
  EXPECT_NEAR(found.largestSeen, 0.2, 1e-5);
  EXPECT_NEAR(found.largest, 0.2, 2e-5);
  EXPECT_GE(found.largest, found.largestSeen);
  EXPECT_NEAR(found.mean, 0.2, 1e-5);
  EXPECT_NEAR(found.volumeRatio, std::pow(5.0 / 3.0, 3), 0.2);
}

TEST(SphereExcess, BoundsHoldForSamples) {
  std::mt19937 random(6);
  for (const auto& body : bodies(random)) {
    const auto spheres = EnclosingSpheresSearch(body, quick()).atMost(8).spheres;
    const SphereExcess found = sphereExcess(body, spheres);
    EXPECT_LE(found.largestSeen, found.largest);
    EXPECT_LE(found.mean, found.largest);
    double sum = 0.0;
    int points = 0;
    for (int i = 0; i < 4000; ++i) {
      const auto& [center, radius] = spheres[static_cast<std::size_t>(
          uniform(random, 0.0, static_cast<double>(spheres.size())))];
      const Vector3d p = center + radius * unitVector(random);
      if (outside(spheres, p) < -1e-12) continue;
      const double apart = std::max(0.0, distanceTo(body, p));
      EXPECT_LE(apart, found.largest + 1e-4);
      sum += apart;
      ++points;
    }
    ASSERT_GT(points, 100);
    EXPECT_LT(found.largestSeen, 1.0);
    EXPECT_NEAR(sum / points, found.mean, 0.5 * found.mean + 1e-3);
  }
}

/// Requested from another thread, at different moments of the work, until it is done before.
template <typename Work>
int stoppedTimes(const Work& work) {
  int stopped = 0;
  for (int wait = 0; wait < 40; wait += 2) {
    std::stop_source stop;
    std::jthread other([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(wait));
      stop.request_stop();
    });
    try {
      work([&] { return stop.stop_requested(); });
    } catch (const SearchStopped& error) {
      EXPECT_STREQ(error.what(), "stopped before it was done");
      ++stopped;
    }
  }
  return stopped;
}

TEST(EnclosingSpheres, AreNoLongerSearchedForOnceStopped) {
  std::mt19937 random(3);
  const auto body = bodies(random).front();
  EXPECT_GT(stoppedTimes([&](const StopQuestion& stop) {
              EnclosingSpheresSearch search(body, {}, stop);
              try {
                search.atMost(12, stop);
              } catch (const SearchStopped&) {
                // Pieces may be missing: nothing more is found.
                EXPECT_THROW(search.atMost(12), SearchStopped);
                EXPECT_THROW(search.within(0.1), SearchStopped);
                EXPECT_THROW(search.countFor(0.1), SearchStopped);
                throw;
              }
            }),
            5);
  const StopQuestion over = [] { return true; };
  EnclosingSpheresSearch search(body, quick());
  EXPECT_THROW(search.within(0.1, over), SearchStopped);
  const std::vector<EnclosingSphere> one{{Vector3d::Zero(), 0.1}};
  EXPECT_THROW(outsideSpheres(body, one, {.stop = over}), SearchStopped);
  EXPECT_THROW(sphereExcess(body, one, {.stop = over}), SearchStopped);
}

TEST(EnclosingShapes, AreNoLongerSearchedForOnceStopped) {
  std::mt19937 random(3);
  const auto body = bodies(random).front();
  for (const EnclosingKind kind :
       {EnclosingKind::Capsule, EnclosingKind::Box, EnclosingKind::Convex}) {
    bool isOver = false;
    const StopQuestion over = [&isOver] { return isOver; };
    EnclosingShapesSearch search(body, kind, {.pieces = 30}, over);
    EXPECT_GT(search.atMost(4, over).shapes.size(), 0u);
    isOver = true;
    EXPECT_THROW(search.atMost(4, over), SearchStopped);
    EXPECT_THROW(search.reachFor(4), SearchStopped);
    EXPECT_THROW(search.countFor(0.1), SearchStopped);
    EXPECT_THROW(search.within(0.1), SearchStopped);
    EXPECT_THROW(EnclosingShapesSearch(body, kind, {}, over), SearchStopped);
  }
}

TEST(EnclosingSpheres, RefuseWhatTheyCannotUse) {
  const std::vector<PosedShape> body{at(Sphere{0.3}, {0, 0, 0})};
  const std::vector<EnclosingSphere> bad{{{0, 0, 0}, -1.0}};
  EXPECT_THROW(outsideSpheres(body, bad), std::invalid_argument);
  EXPECT_THROW(sphereExcess(body, bad), std::invalid_argument);
  EXPECT_THROW(EnclosingSpheresSearch(std::vector<PosedShape>{}), std::invalid_argument);
  EXPECT_THROW(EnclosingSpheresSearch(body).atMost(0), std::invalid_argument);
  EXPECT_THROW(EnclosingSpheresSearch(body).within(0.0), std::invalid_argument);
  EXPECT_THROW(EnclosingSpheresSearch(std::vector{at(Plane{{0, 0, 1}, 0.0}, {0, 0, 0})}),
               std::invalid_argument);
  EXPECT_TRUE(std::isinf(outsideSpheres(body, {}).lower));
  EXPECT_EQ(EnclosingSpheresSearch(body).atMost(3).spheres.size(), 1u);
}

}  // namespace
