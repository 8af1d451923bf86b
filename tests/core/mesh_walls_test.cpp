// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <set>
#include <vector>

#include "broken_solids.hpp"
#include "mesh_samples.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using test::Soup;

TriangleMesh build(const Soup& soup) {
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

TEST(MeshWalls, ASheetOnAnEdgeOfASolidLeavesItSolid) {
  const Soup box = test::boxSoup(-Vector3d::Ones(), Vector3d::Ones());
  std::mt19937 random(3);
  for (const bool isBroken : {false, true}) {
    Soup soup = isBroken ? test::broken(box, random, 0.0) : box;
    soup.append({{{1, -1, 1}, {1, 1, 1}, {1, 0, 3}}, {{0, 1, 2}}});
    const TriangleMesh mesh = build(soup);
    EXPECT_FALSE(mesh.isClosed());
    EXPECT_EQ(mesh.report().closedComponents, 1);
    EXPECT_EQ(mesh.report().openComponents, 1);
    EXPECT_TRUE(mesh.encloses({0.2, 0.2, 0.3}));
    EXPECT_FALSE(mesh.encloses({1.1, 0.0, 1.5}));
    EXPECT_EQ(mesh.componentPoints().size(), 2U);
    EXPECT_EQ(mesh.convexParts().size(), 1U);
  }
  // A sheet on the edge of a box without a lid makes none.
  Soup open = box;
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);
  open.append({{{1, -1, 1}, {1, 1, 1}, {1, 0, 3}}, {{0, 1, 2}}});
  EXPECT_EQ(build(open).report().closedComponents, 0);
}

TEST(MeshWalls, AWallInASolidLeavesBothSidesSolid) {
  Soup soup = test::boxSoup(-Vector3d::Ones(), Vector3d::Ones());
  // Along diagonals of two faces, which it shares with their triangles.
  ASSERT_EQ(soup.triangles[0], Vector3i(0, 2, 1));
  ASSERT_EQ(soup.triangles[2], Vector3i(4, 5, 6));
  soup.triangles.emplace_back(1, 2, 6);
  soup.triangles.emplace_back(1, 6, 5);
  const TriangleMesh mesh = build(soup);
  EXPECT_TRUE(mesh.isClosed());
  EXPECT_TRUE(mesh.encloses({-0.5, -0.5, 0.1}));
  EXPECT_TRUE(mesh.encloses({0.5, 0.5, 0.1}));
  EXPECT_FALSE(mesh.encloses({0.5, 0.5, 1.1}));
}

/// Cells of a grid between walls that are there or not, each wall written once.
class Walls {
 public:
  static constexpr int kCells = 3;
  using Cell = std::array<int, 3>;

  Walls(std::mt19937& random, double share) {
    std::bernoulli_distribution isThere(share);
    for (int x = 0; x <= kCells; ++x)
      for (int y = 0; y <= kCells; ++y)
        for (int z = 0; z <= kCells; ++z)
          for (int axis = 0; axis < 3; ++axis) {
            const std::array<int, 4> wall = {x, y, z, axis};
            if (wall[(axis + 1) % 3] == kCells || wall[(axis + 2) % 3] == kCells) continue;
            if (isThere(random)) walls_.insert(wall);
          }
  }

  Soup soup() const {
    Soup soup;
    const auto index = [](const Eigen::Vector3i& at) {
      constexpr int kCorners = kCells + 1;
      return at[0] + kCorners * (at[1] + kCorners * at[2]);
    };
    for (int i = 0; i < (kCells + 1) * (kCells + 1) * (kCells + 1); ++i)
      soup.vertices.emplace_back(i % (kCells + 1), i / (kCells + 1) % (kCells + 1),
                                 i / (kCells + 1) / (kCells + 1));
    for (const auto& [x, y, z, axis] : walls_) {
      const Vector3i a(x, y, z);
      const Vector3i u = Vector3i::Unit((axis + 1) % 3), v = Vector3i::Unit((axis + 2) % 3);
      soup.triangles.emplace_back(index(a), index(a + u), index(a + u + v));
      soup.triangles.emplace_back(index(a), index(a + u + v), index(a + v));
    }
    return soup;
  }

  /// The cells that a way leads to from outside, through no wall.
  std::set<Cell> outside() const {
    std::set<Cell> seen;
    std::vector<Cell> pending = {{-1, -1, -1}};
    while (!pending.empty()) {
      const Cell cell = pending.back();
      pending.pop_back();
      if (!seen.insert(cell).second) continue;
      for (int axis = 0; axis < 3; ++axis)
        for (const int step : {-1, 1}) {
          Cell next = cell;
          next[axis] += step;
          const Cell& upper = step > 0 ? next : cell;
          const bool inGrid = next[axis] >= -1 && next[axis] <= kCells;
          if (inGrid && !walls_.contains({upper[0], upper[1], upper[2], axis}))
            pending.push_back(next);
        }
    }
    return seen;
  }

 private:
  std::set<std::array<int, 4>> walls_;  ///< lowest corner and normal
};

TEST(MeshWalls, WhatNoWayLeadsToIsInside) {
  std::mt19937 random(20261126);
  int inside = 0, outside = 0, roomsOfCells = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Walls walls(random, 0.6 + 0.1 * (trial % 5));
    const std::set<Walls::Cell> reached = walls.outside();
    Soup soup = walls.soup();
    if (trial % 3 == 1) soup = test::broken(soup, random, 1e-9);
    if (trial % 3 == 2) soup = test::broken(soup, random, 1e-6);
    const TriangleMesh mesh = build(soup);
    int enclosed = 0;
    for (int i = 0; i < Walls::kCells * Walls::kCells * Walls::kCells; ++i) {
      const Walls::Cell cell = {i % Walls::kCells, i / Walls::kCells % Walls::kCells,
                                i / Walls::kCells / Walls::kCells};
      const bool isInside = !reached.contains(cell);
      EXPECT_EQ(mesh.encloses(Vector3d(cell[0] + 0.41, cell[1] + 0.53, cell[2] + 0.57)), isInside)
          << trial;
      ++(isInside ? inside : outside);
      enclosed += isInside ? 1 : 0;
    }
    roomsOfCells += enclosed > 1 ? 1 : 0;
  }
  EXPECT_GT(inside, 300);
  EXPECT_GT(outside, 500);
  EXPECT_GT(roomsOfCells, 20);
}

}  // namespace
}  // namespace swept
