// SPDX-License-Identifier: BSD-3-Clause
// Faces of any number of corners become triangles that cover them: no surface is lost, and none is
// made up.
#include "io/face_cutter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "io/mesh_content.hpp"

namespace swept {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3i;
using Outline = std::vector<Vector2d>;

/// On a plane of that frame.
std::vector<Vector3d> lifted(const Outline& outline, const Eigen::Isometry3d& frame) {
  std::vector<Vector3d> points;
  for (const Vector2d& p : outline) points.push_back(frame * Vector3d(p.x(), p.y(), 0.0));
  return points;
}

std::vector<Vector3i> cut(const std::vector<Vector3d>& points) {
  const detail::InputSource source("m.obj", {});
  std::vector<int> corners(points.size());
  std::iota(corners.begin(), corners.end(), 0);
  std::vector<Vector3i> triangles;
  detail::FaceCutter(source).cut(corners, points, triangles, 7);
  return triangles;
}

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// How often the outline winds around a point.
double winding(const Outline& outline, const Vector2d& point) {
  double angle = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d a = outline[i] - point, b = outline[(i + 1) % outline.size()] - point;
    angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return angle / (2.0 * std::numbers::pi);
}

/// Holds the triangles against the outline at random points: as many of them contain one as the
/// outline winds around it.
void expectCovered(const Outline& outline, std::mt19937& random) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  const Eigen::Isometry3d frame =
      Eigen::Translation3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)) *
      Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))
          .normalized();
  const std::vector<Vector3i> triangles = cut(lifted(outline, frame));
  ASSERT_EQ(triangles.size(), outline.size() - 2);
  for (int i = 0; i < 200; ++i) {
    const Vector2d point(uniform(-1.2, 1.2), uniform(-1.2, 1.2));
    int inside = 0;
    bool isNear = false;
    for (const Vector3i& t : triangles) {
      int left = 0, right = 0;
      for (int k = 0; k < 3; ++k) {
        const double side = turn(outline[t[k]], outline[t[(k + 1) % 3]], point);
        isNear = isNear || std::abs(side) < 1e-9;
        left += side > 0.0;
        right += side < 0.0;
      }
      inside += left == 3 || right == 3;
    }
    if (isNear) continue;
    EXPECT_EQ(inside, std::lround(std::abs(winding(outline, point))));
  }
}

TEST(FaceCutter, StarsAndConvexFacesAreCovered) {
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    const int count = 4 + round % 40;
    Outline outline;
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / count;
      const double radius =
          round % 3 == 0 ? 1.0 : std::uniform_real_distribution<>(0.1, 1.0)(random);
      outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    if (round % 2 == 0) std::ranges::reverse(outline);
    std::ranges::rotate(outline, outline.begin() + count / 3);
    expectCovered(outline, random);
  }
}

/// Spirals and combs have few ears.
TEST(FaceCutter, SpiralsAndCombsAreCovered) {
  std::mt19937 random(5);
  for (const int count : {5, 8, 20, 60}) {
    Outline spiral, comb;
    for (int i = 0; i < count; ++i) {
      const double angle = 9.0 * i / count, radius = 0.2 + 0.7 * i / count;
      spiral.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
      comb.emplace_back(-1.0 + 2.0 * i / count, i % 2 == 0 ? 0.9 : -0.5);
    }
    for (int i = count - 1; i >= 0; --i) {
      const double angle = 9.0 * i / count, radius = 0.15 + 0.7 * i / count;
      spiral.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    comb.emplace_back(1.0, -1.0);
    comb.emplace_back(-1.0, -1.0);
    expectCovered(spiral, random);
    expectCovered(comb, random);
  }
}

/// A square with a square hole, to which the outline goes and comes back by the same way.
TEST(FaceCutter, HolesWithABridgeStayHoles) {
  std::mt19937 random(7);
  const Outline outline{{-1, -1},     {1, -1},     {1, 1},     {-1, 1},     {-1, -1},
                        {-0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}};
  expectCovered(outline, random);
}

TEST(FaceCutter, FourCornersAreDividedWhereTheyAreConcave) {
  std::mt19937 random(9);
  for (int first = 0; first < 4; ++first) {
    Outline dart{{0, 0.9}, {-0.8, -0.7}, {0, -0.2}, {0.8, -0.7}};
    std::ranges::rotate(dart, dart.begin() + first);
    expectCovered(dart, random);
  }
  const std::vector<Vector3d> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ(cut(square), (std::vector<Vector3i>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(FaceCutter, FacesThatCrossThemselvesAreRefused) {
  const auto said = [](const std::vector<Vector3d>& points) {
    return test::inputError([&] { cut(points); });
  };
  const std::string crosses =
      "m.obj:7: error: a face of 5 corners crosses or touches itself; a face of more than 4 "
      "corners "
      "must not, or has to be given as triangles";
  // A star of one line, and two faces that turn both ways by the same area, so that there is no
  // normal.
  std::vector<Vector3d> star;
  for (int i = 0; i < 5; ++i)
    star.emplace_back(std::cos(2.4 * std::numbers::pi / 3.0 * i), 0.0,
                      std::sin(2.4 * std::numbers::pi / 3.0 * i));
  EXPECT_EQ(said(star), crosses);
  EXPECT_EQ(said({{0, 0, 0}, {0.4, -0.04, 0}, {1, 0, 0}, {1, -0.02, 0}, {0, -0.02, 0}}), crosses);
  EXPECT_EQ(said({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0.5, 0.5, 0}, {0, 1, 0}}), crosses);
}

/// Corners at one place, or on one line, cover nothing.
TEST(FaceCutter, FacesWithoutAreaAreKept) {
  EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1, 0, 0}}).size(), 3U);
  EXPECT_EQ(cut({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}).size(), 3U);
  std::mt19937 random(11);
  expectCovered({{-1, -1}, {0, -1}, {1, -1}, {1, 1}, {1, 1}, {0, 1}, {0, 0}, {-1, 1}}, random);
}

/// Faces of many corners take no longer than a file of their size may.
TEST(FaceCutter, LargeFacesAreCutOrRefusedInTime) {
  std::vector<Vector3d> round, comb;
  constexpr int kCount = 200'000;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCount;
    round.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    comb.emplace_back(i, i % 2 == 0 ? 1.0 : 0.0, 0.0);
  }
  comb.emplace_back(kCount, -1.0, 0.0);
  comb.emplace_back(0.0, -1.0, 0.0);
  EXPECT_EQ(cut(round).size(), std::size_t{kCount} - 2);
  EXPECT_EQ(test::inputError([&] { cut(comb); }),
            "m.obj:7: error: a face of 200002 corners is concave, and too much of the file is; it "
            "has to be given as triangles");
}

}  // namespace
}  // namespace swept
