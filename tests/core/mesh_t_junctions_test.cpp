// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "broken_solids.hpp"
#include "mesh_samples.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using test::Soup;

TriangleMesh build(const Soup& soup) {
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

double gap(const TriangleMesh& mesh, const Vector3d& point) {
  Eigen::Isometry3d mesh_from_point = Eigen::Isometry3d::Identity();
  mesh_from_point.translation() = point;
  return distance(mesh, Sphere{0.0}, mesh_from_point).lower;
}

/// The cube from -1 m to 1 m whose top has a corner more, in the middle of an edge.
Soup cubeWithTJunction() {
  Soup soup = test::boxSoup(-Vector3d::Ones(), Vector3d::Ones());
  soup.vertices.emplace_back(0.0, -1.0, 1.0);
  EXPECT_EQ(soup.triangles[2], Vector3i(4, 5, 6));
  soup.triangles[2] = {4, 8, 6};
  soup.triangles.emplace_back(8, 5, 6);
  return soup;
}

/// Whether a point on a grid around [-1.2, 1.2]^3 m is enclosed that is farther than `far` (m) from
/// all triangles.
bool enclosesFarPoint(const TriangleMesh& mesh, double far) {
  const TriangleMesh surface =
      TriangleMesh::build(mesh.vertices(), mesh.triangles(), MeshInterior::Surface, 0.0);
  constexpr int kSteps = 12;
  for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
    const Vector3d at(i % kSteps, i / kSteps % kSteps, i / kSteps / kSteps);
    const Vector3d point = (at.array() + 0.47) / kSteps * 2.4 - 1.2;
    if (mesh.encloses(point) && gap(surface, point) > far) return true;
  }
  return false;
}

TEST(MeshTJunctions, ACornerOnAnEdgeLeavesASolid) {
  const TriangleMesh mesh = build(cubeWithTJunction());
  EXPECT_TRUE(mesh.isClosed());
  EXPECT_EQ(mesh.report().closedComponents, 1);
  EXPECT_EQ(mesh.report().cracksFilled, 1);
  EXPECT_EQ(mesh.report().largestCrack, 0.0);
  EXPECT_EQ(mesh.opening(), 0.0);
  EXPECT_TRUE(mesh.encloses({0.2, 0.2, 0.3}));
  EXPECT_FALSE(mesh.encloses({0.2, 0.2, 1.3}));
  EXPECT_NEAR(gap(mesh, {0.0, 0.0, 1.5}), 0.5, 1e-12);
  EXPECT_EQ(gap(mesh, {0.2, 0.2, 0.3}), 0.0);
  // Its hull is exact, and so is its depth.
  EXPECT_EQ(mesh.convexParts().size(), 1U);
}

TEST(MeshTJunctions, ZeroWidthFillsNothing) {
  const Soup soup = cubeWithTJunction();
  const TriangleMesh mesh =
      TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Solid, 0.0);
  EXPECT_FALSE(mesh.isClosed());
  EXPECT_EQ(mesh.triangles().size(), soup.triangles.size());
}

TEST(MeshTJunctions, CracksOfAMillionthAreFilledInAnyUnit) {
  // Faces of a box of 2 m, each off by itself.
  std::mt19937 random(17);
  for (const double unit : {1.0, 1000.0, 1e-3, 1e-30, 1e30}) {
    Soup box = test::boxSoup(-Vector3d::Ones(), Vector3d::Ones());
    Soup soup;
    for (std::size_t i = 0; i < box.triangles.size(); i += 2) {
      Soup face = {box.vertices, {box.triangles[i], box.triangles[i + 1]}};
      const Vector3d by = 1e-6 * test::unitVector(random);
      for (Vector3d& vertex : face.vertices) vertex += by;
      soup.append(face);
    }
    const TriangleMesh mesh = build(test::scaledSoup(soup, unit));
    EXPECT_TRUE(mesh.isClosed()) << unit;
    EXPECT_GT(mesh.report().largestCrack, 1e-7 * unit);
    EXPECT_LT(mesh.report().largestCrack, 1e-5 * unit);
    EXPECT_TRUE(mesh.encloses(unit * Vector3d(0.2, 0.2, 0.3)));
    EXPECT_FALSE(mesh.encloses(unit * Vector3d(0.2, 0.2, 1.3)));
  }
}

TEST(MeshTJunctions, BrokenSolidsAreTheSolids) {
  std::mt19937 random(20261126);
  int inside = 0, outside = 0, divided = 0, filled = 0;
  for (int trial = 0; trial < 12; ++trial) {
    for (const double error : {0.0, 1e-9, 1e-7, 1e-6}) {
      for (const Soup& straight :
           {test::boxSoup(Vector3d(-0.7, -1.0, -0.3), Vector3d(0.7, 1.0, 0.3)), test::angleSoup(),
            test::torusSoup(12, 9, 0.7, 0.3), test::blobSoup(random, 6, 8)}) {
        const Soup solid = straight.moved(test::randomPose(random, 0.2));
        const TriangleMesh whole =
            TriangleMesh::build(solid.vertices, solid.triangles, MeshInterior::Solid, 0.0);
        ASSERT_TRUE(whole.isClosed());
        const Soup soup = test::broken(solid, random, error);
        const TriangleMesh mesh = build(soup);
        ASSERT_TRUE(mesh.isClosed()) << trial << ' ' << error;
        ASSERT_EQ(mesh.report().closedComponents, 1);
        divided += soup.triangles.size() > 3 * solid.triangles.size() ? 1 : 0;
        filled += mesh.report().cracksFilled > 0 ? 1 : 0;
        // Rounding to doubles alone, or the jitter of what is merged.
        const double crack = std::max(1e-14, 40.0 * error);
        EXPECT_LE(mesh.report().largestCrack, std::max(1e-15, 40.0 * error));
        for (int i = 0; i < 40; ++i) {
          const Vector3d point = test::uniformPoint(random, 1.0);
          const double apart = gap(whole, point);
          EXPECT_NEAR(gap(mesh, point), apart, 1e-9 + crack);
          const bool enclosed = whole.encloses(point);
          if (!enclosed && apart < crack) continue;
          EXPECT_EQ(mesh.encloses(point), enclosed);
          ++(enclosed ? inside : outside);
        }
      }
    }
  }
  EXPECT_EQ(divided, 12 * 4 * 4);
  EXPECT_EQ(filled, 12 * 4 * 4);
  EXPECT_GT(inside, 700);
  EXPECT_GT(outside, 3000);
}

TEST(MeshTJunctions, HolesOfOneTriangleStayOpen) {
  std::mt19937 random(23);
  for (int trial = 0; trial < 25; ++trial) {
    for (const Soup& solid : {test::boxSoup(-Vector3d::Ones(), Vector3d::Ones()), test::angleSoup(),
                              test::torusSoup(12, 9, 0.7, 0.3), test::blobSoup(random, 6, 8)}) {
      std::vector<std::size_t> firstOf;
      Soup soup = test::broken(solid, random, trial % 2 == 0 ? 0.0 : 1e-6, &firstOf);
      const std::size_t hole = random() % solid.triangles.size();
      const auto begin = soup.triangles.begin();
      soup.triangles.erase(begin + static_cast<std::ptrdiff_t>(firstOf[hole]),
                           begin + static_cast<std::ptrdiff_t>(firstOf[hole + 1]));
      const TriangleMesh mesh = build(soup);
      EXPECT_FALSE(mesh.isClosed());
      EXPECT_EQ(mesh.report().closedComponents, 0);
      EXPECT_EQ(mesh.report().cracksFilled, 0);
      EXPECT_GT(mesh.opening(), 1e-3);
    }
  }
}

TEST(MeshTJunctions, StripsOfASphereMeetHoweverTheyAreDivided) {
  // Between circles of latitude, each circle a polygon of 12 sides. A strip divides the sides of
  // both its circles into as many pieces as its number says.
  constexpr int kStrips = 8, kSides = 12;
  Soup soup;
  const auto corner = [](int circle, double side) {
    const double polar = std::numbers::pi * circle / kStrips;
    const auto on = [&](int i) {
      const double angle = 2.0 * std::numbers::pi * (i % kSides) / kSides;
      return Vector3d(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
                      std::cos(polar));
    };
    if (circle == 0 || circle == kStrips) return Vector3d(0.0, 0.0, circle == 0 ? 1.0 : -1.0);
    const int i = static_cast<int>(std::floor(side));
    return Vector3d(on(i) + (side - i) * (on(i + 1) - on(i)));
  };
  for (int strip = 0; strip < kStrips; ++strip) {
    const int pieces = kSides * (strip % 5 + 1);
    for (int i = 0; i < pieces; ++i) {
      const double from = static_cast<double>(i) / (strip % 5 + 1);
      const double to = (i + 1.0) / (strip % 5 + 1);
      soup.append(
          {{corner(strip, from), corner(strip + 1, from), corner(strip + 1, to), corner(strip, to)},
           {{0, 1, 2}, {0, 2, 3}}});
    }
  }
  const TriangleMesh mesh = build(soup);
  EXPECT_TRUE(mesh.isClosed());
  EXPECT_LT(mesh.report().largestCrack, 1e-15);
  EXPECT_TRUE(mesh.encloses(Vector3d(0.1, 0.2, 0.3)));
  EXPECT_FALSE(mesh.encloses(Vector3d(0.9, 0.9, 0.3)));
}

TEST(MeshTJunctions, SurfacesWithNearBordersHaveNoRoomInside) {
  const Soup sheet = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  EXPECT_FALSE(build(sheet).isClosed());
  // Two sheets as far apart as a crack is wide: what is between them may be filled, nothing else.
  for (const double apart : {1e-7, 1e-5, 1e-4, 1e-2}) {
    Soup two = sheet;
    two.append(sheet.moved(Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, apart))));
    EXPECT_FALSE(enclosesFarPoint(build(two), 1e-4));
  }
  // Folded, so that all of its border lies on itself or near it.
  for (const double apart : {0.0, 1e-7}) {
    const Soup folded = {{{0, -1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 0, apart}}, {{0, 1, 2}, {1, 0, 3}}};
    EXPECT_FALSE(enclosesFarPoint(build(folded), 1e-4));
  }
  // A bowl, written twice a little apart, with different borders.
  Soup bowl = test::boxSoup(-Vector3d::Ones(), Vector3d::Ones());
  bowl.triangles.erase(bowl.triangles.begin() + 2, bowl.triangles.begin() + 4);
  std::mt19937 random(29);
  Soup bowls = test::broken(bowl, random, 1e-7);
  bowls.append(test::broken(bowl, random, 1e-7));
  EXPECT_FALSE(enclosesFarPoint(build(bowls), 1e-4));
  // A tube without ends, and a Moebius band.
  Soup tube = test::boxSoup(-Vector3d::Ones(), Vector3d::Ones());
  tube.triangles.erase(tube.triangles.begin(), tube.triangles.begin() + 4);
  EXPECT_FALSE(build(tube).isClosed());
  for (const double width : {0.3, 1e-3, 1e-6}) {
    Soup band;
    constexpr int kSteps = 40;
    for (int i = 0; i <= kSteps; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kSteps;
      for (const double across : {-width, width}) {
        const double radial = 0.8 + across * std::cos(angle / 2.0);
        band.vertices.emplace_back(radial * std::cos(angle), radial * std::sin(angle),
                                   across * std::sin(angle / 2.0));
      }
      if (i == kSteps) continue;
      band.triangles.emplace_back(2 * i, 2 * i + 1, 2 * i + 2);
      band.triangles.emplace_back(2 * i + 1, 2 * i + 3, 2 * i + 2);
    }
    EXPECT_FALSE(enclosesFarPoint(build(band), 1e-4)) << width;
  }
}

TEST(MeshTJunctions, ASheetThatTouchesASolidLeavesItSolid) {
  // The faces of the cube are apart from each other, and a sheet hangs on one of its edges.
  std::mt19937 random(31);
  for (const double error : {0.0, 1e-7}) {
    Soup soup = test::broken(test::boxSoup(-Vector3d::Ones(), Vector3d::Ones()), random, error);
    soup.append({{{1, -1, 1}, {1, 1, 1}, {1, 0, 3}}, {{0, 1, 2}}});
    const TriangleMesh mesh = build(soup);
    EXPECT_FALSE(mesh.isClosed());
    EXPECT_EQ(mesh.report().closedComponents, 1);
    EXPECT_EQ(mesh.report().openComponents, 1);
    EXPECT_TRUE(mesh.encloses({0.2, 0.2, 0.3}));
    EXPECT_FALSE(mesh.encloses({0.9, 0.0, 1.1}));
  }
}

TEST(MeshTJunctions, ShellsThatAreNestedStaySolids) {
  std::mt19937 random(37);
  const Soup outer = test::boxSoup(-Vector3d::Ones(), Vector3d::Ones());
  for (const bool inverted : {false, true}) {
    Soup inner = test::scaledSoup(outer, 0.5);
    if (inverted) inner = inner.inverted();
    Soup soup = test::broken(outer, random, 1e-7);
    soup.append(test::broken(inner, random, 1e-7));
    const TriangleMesh mesh = build(soup);
    EXPECT_TRUE(mesh.isClosed());
    EXPECT_EQ(mesh.report().closedComponents, 2);
    EXPECT_TRUE(mesh.encloses({0.75, 0.1, 0.2}));
    EXPECT_TRUE(mesh.encloses({0.1, 0.2, 0.3}));
  }
  // Each triangle twice, once for each side.
  Soup both = cubeWithTJunction();
  both.append(both.inverted());
  EXPECT_TRUE(build(both).isClosed());
  EXPECT_TRUE(build(both).encloses({0.2, 0.2, 0.3}));
}

TEST(MeshTJunctions, OpeningIsWhatHasToBeFilled) {
  for (const double height : {1e-4, 1e-3, 0.03}) {
    // A lid above the box, all of it.
    Soup soup = test::boxSoup(-Vector3d::Ones(), Vector3d::Ones());
    for (int i = 0; i < 4; ++i)
      soup.vertices.emplace_back(soup.vertices[i + 4] + Vector3d(0.0, 0.0, height));
    soup.triangles[2] = {8, 9, 10};
    soup.triangles[3] = {9, 11, 10};
    const TriangleMesh mesh = build(soup);
    EXPECT_FALSE(mesh.isClosed());
    EXPECT_GE(mesh.opening(), height * (1.0 - 1e-12));
    EXPECT_LE(mesh.opening(), 2.0 * height);
    const auto with = [&](double width) {
      return TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Solid, width);
    };
    EXPECT_TRUE(with(mesh.opening()).isClosed());
    EXPECT_FALSE(with(0.5 * mesh.opening()).isClosed());
    EXPECT_LE(with(mesh.opening()).report().largestCrack, 5.0 * mesh.opening());
  }
  EXPECT_EQ(build({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}).opening(),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace swept
