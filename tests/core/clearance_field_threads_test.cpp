// SPDX-License-Identifier: BSD-3-Clause
// The field of a cloud is the same whatever the number of threads and the instruction set, and its
// values are those of the definition, by brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "clearance_grid/field_distances.hpp"
#include "clearance_grid/voxels.hpp"
#include "simd_targets.hpp"
#include "swept/core/clearance_field.hpp"
#include "swept/core/point_cloud.hpp"
#include "threads/crew.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;

constexpr double kSide = 0.01;
constexpr std::array<int, 3> kBlocks{11, 9, 13};

/// Balls in a part of the grid, some beyond it; of one voxel and of a dozen.
PointCloud cloudOf(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> along(-0.05, 0.25), radius(0.0, 0.03);
  std::vector<Vector3d> points;
  std::vector<double> radii;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(along(random), along(random), along(random));
    radii.push_back(radius(random));
  }
  return PointCloud::build(points, radii);
}

struct Made {
  Voxels voxels;
  ClearanceField field;
};

Made made(const PointCloud& cloud, unsigned threads, bool isCut) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Crew crew(threads);
  Made result{Voxels(Vector3d::Zero(), kSide, kBlocks, 1.0), {}};
  ClearanceField& field = result.field;
  field.voxel = static_cast<float>(kSide);
  field.origin.setZero();
  field.blocks = kBlocks;
  field.lower = isCut ? Vector3d(0.0, -kInfinity, 0.0) : Vector3d(0.0, 0.0, 0.0);
  field.upper = isCut ? Vector3d(1.0, 1.0, kInfinity) : Vector3d(1.0, 1.0, 1.0);
  result.voxels.mark(cloud, crew);
  measureCells(result.voxels, crew, field);
  measureBricks(result.voxels, crew, field);
  return result;
}

TEST(ClearanceFieldThreads, AreOfNoMatter) {
  for (const bool isCut : {false, true}) {
    const PointCloud cloud = cloudOf(9000, 3);
    const Made truth = made(cloud, 1, isCut);
    EXPECT_GT(truth.field.voxels.size(), 1600U);
    for (const std::int64_t target : simd_test::simdTargets()) {
      const simd_test::OnTarget on(target);
      for (const unsigned threads : {1U, 2U, 5U}) {
        const Made other = made(cloud, threads, isCut);
        EXPECT_EQ(other.field.cells, truth.field.cells);
        EXPECT_EQ(other.field.bricks, truth.field.bricks);
        EXPECT_EQ(other.field.voxels, truth.field.voxels);
      }
    }
  }
}

/// A voxel is marked exactly if the ball, grown a little by rounding, meets it.
TEST(ClearanceFieldThreads, MarkTheVoxelsThatBallsMeet) {
  const PointCloud cloud = cloudOf(60, 4);
  const Made all = made(cloud, 3, false);
  int marked = 0, unmarked = 0;
  for (int z = 0; z < 4 * kBlocks[2]; ++z) {
    for (int y = 0; y < 4 * kBlocks[1]; ++y) {
      for (int x = 0; x < 4 * kBlocks[0]; ++x) {
        const Vector3d middle = kSide * Vector3d(x + 0.5, y + 0.5, z + 0.5);
        double gap = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < cloud.points().size(); ++i) {
          const Vector3d off = (middle - cloud.points()[i]).cwiseAbs();
          const Vector3d beyond = (off.array() - 0.5 * kSide).max(0.0);
          gap = std::min(gap, beyond.norm() - cloud.radius(i));
        }
        const bool isMarked =
            (all.voxels.block(x / 4, y / 4, z / 4) >> (x % 4 + 4 * (y % 4) + 16 * (z % 4)) & 1U) !=
            0;
        ++(isMarked ? marked : unmarked);
        if (gap <= 0.0) {
          EXPECT_TRUE(isMarked) << x << " " << y << " " << z;
        }
        if (gap > 1e-9) {
          EXPECT_FALSE(isMarked) << x << " " << y << " " << z;
        }
      }
    }
  }
  EXPECT_GT(marked, 1000);
  EXPECT_GT(unmarked, 1000);
}

/// Of cells, without what a cut adds.
TEST(ClearanceFieldThreads, MeasureCellsAsEachPairOfThemSays) {
  const Made all = made(cloudOf(40, 5), 2, false);
  const std::array<int, 3> count{2 * kBlocks[0], 2 * kBlocks[1], 2 * kBlocks[2]};
  std::vector<Vector3d> marked;
  for (int z = 0; z < count[2]; ++z)
    for (int y = 0; y < count[1]; ++y)
      for (int x = 0; x < count[0]; ++x)
        if (all.voxels.cell(x, y, z)) marked.emplace_back(x, y, z);
  ASSERT_GT(marked.size(), 50U);
  std::size_t i = 0, far = 0;
  for (int z = 0; z < count[2]; ++z) {
    for (int y = 0; y < count[1]; ++y) {
      for (int x = 0; x < count[0]; ++x, ++i) {
        // In cells, from the middle of this one to the nearest point of a marked one.
        double gap = 19.5;
        for (const Vector3d& other : marked) {
          const Vector3d off = (other - Vector3d(x, y, z)).cwiseAbs();
          gap = std::min(gap, (off.array() - 0.5).max(0.0).matrix().norm());
        }
        far += gap > 10.0 ? 1 : 0;
        const auto steps = static_cast<double>(all.field.cells[i / 4] >> (8 * (i % 4)) & 255U);
        const double said = steps * static_cast<double>(all.field.step) / (2.0 * kSide);
        EXPECT_LE(said, gap);
        EXPECT_GE(said, gap - 0.1);
      }
    }
  }
  EXPECT_GT(far, 100U);
}

}  // namespace
}  // namespace swept::detail
