// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cover/cells.hpp"
#include "cover_samples.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;

std::vector<Cell> divide(Cells& cells, double size) {
  std::vector<Cell> pending{cells.root()};
  std::vector<Cell> small;
  while (!pending.empty()) {
    Cell cell = std::move(pending.back());
    pending.pop_back();
    if (cell.size() > size) {
      cells.split(cell, pending);
    } else {
      cells.gather(cell);
      small.push_back(std::move(cell));
    }
  }
  return small;
}

double distanceToHull(const Cell& cell, const Vector3d& p) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = p;
  return distance(ConvexHull::of(cell.content), Sphere{0.0}, pose).lower;
}

/// Each point of the shape is in the hull of the content of a cell around it, and that content is
/// in the ball that the cell gives for it.
void expectContent(const Shape& shape, double size) {
  std::mt19937 random(6);
  const Solid solid(shape);
  Cells cells(solid);
  const std::vector<Cell> all = divide(cells, size);
  const double rounding = 1e-12 * solid.scale();
  int solids = 0;
  for (const Cell& cell : all) {
    solids += cell.isSolid() ? 1 : 0;
    EXPECT_TRUE(cell.isIn(cell.middle, cell.reach * (1.0 + 1e-12)));
    EXPECT_FALSE(cell.isIn(cell.middle, cell.reach * 0.999));
  }
  EXPECT_GT(solids, 0);
  for (const Vector3d& p : std::visit(test::SampleOf(random, 1500), shape)) {
    const bool found = std::any_of(all.begin(), all.end(), [&](const Cell& cell) {
      return ((p - cell.lower).array() >= -rounding).all() &&
             ((cell.upper - p).array() >= -rounding).all() &&
             distanceToHull(cell, p) <= cell.blur + rounding;
    });
    ASSERT_TRUE(found) << "point " << p.transpose();
  }
}

TEST(CoverCells, HoldWhatTheShapeHasInThem) {
  std::mt19937 random(12);
  const auto mesh = [](const test::Soup& soup) {
    return TriangleMesh::build(soup.vertices, soup.triangles);
  };
  for (const double size : {0.25, 0.13}) {
    SCOPED_TRACE(size);
    expectContent(mesh(test::blobSoup(random, 7, 9).moved(test::randomPose(random, 0.3))), size);
    expectContent(mesh(test::torusSoup(20, 10, 0.8, 0.4).moved(test::randomPose(random, 0.3))),
                  0.5 * size);
    test::Soup cross = test::boxSoup({-1.0, -0.4, -0.3}, {1.0, 0.4, 0.3});
    cross.append(test::boxSoup({-0.3, -0.9, -0.3}, {0.3, 0.9, 0.3}));
    expectContent(mesh(cross.moved(test::randomPose(random, 0.3))), 0.5 * size);
  }
}

TEST(CoverCells, CutsThatPassWithinRoundingOfASideLoseNothing) {
  // The first cut halves the box at x = 0: the side of the second box lies there, but for a hair.
  for (const double hair : {0.0, 1e-17, -1e-17, 1e-16, -1e-16, 1e-15, -1e-15, 1e-13, -1e-13}) {
    SCOPED_TRACE(hair);
    test::Soup soup = test::boxSoup({-1.0, -1.0, -1.0}, {hair, 1.0, 1.0});
    soup.append(test::boxSoup({0.5, -1.0, -1.0}, {1.0, 1.0, 1.0}));
    expectContent(TriangleMesh::build(soup.vertices, soup.triangles), 0.26);
  }
}

}  // namespace
}  // namespace swept::detail
