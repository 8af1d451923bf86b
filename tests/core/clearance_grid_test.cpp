// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/clearance_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "clearance_grid_samples.hpp"
#include "heap_counter.hpp"
#include "message_of.hpp"
#include "simd_targets.hpp"
#include "swept/core/clearance_field.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;
using test::ClearanceScene;
using test::uniform;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const ClearanceGridOptions kFewCells{.window = ClearanceGridOptions().window, .cells = 5000};

/// m; a side or two of the shape's box are cut off, or none.
Aabb randomWindow(const Shape& shape, std::mt19937& random) {
  Aabb window = ClearanceGridOptions().window;
  const Aabb box = boundingBox(shape);
  for (int i = 0; i < 3; ++i) {
    const double at = uniform(random, box.lower[i], box.upper[i]);
    if (random() % 4 == 0) window.lower[i] = std::min(at, box.center()[i]);
    if (random() % 4 == 0) window.upper[i] = std::max(at, box.center()[i]);
  }
  return window;
}

/// How often each case was met.
struct Counts {
  int positive = 0;
  int near = 0;
  int inside = 0;
  int farther = 0;
  int unknown = 0;
};

void judge(const ClearanceScene& scene, const ClearanceGrid& grid, const Vector3d& p,
           std::mt19937& random, Counts& counts) {
  const double exact = scene.distance(p);
  const double bound = grid.clearance(p);
  ASSERT_LE(bound, exact) << p.transpose();
  ASSERT_GE(bound, 0.0);
  // Of radii about the distance, and just above and below the bound.
  const double radius = exact * uniform(random, 0.3, 1.1);
  const bool farther = grid.isFarther(p, radius);
  if (farther) {
    ASSERT_GT(exact, radius) << p.transpose();
  }
  ASSERT_FALSE(grid.isFarther(p, bound * (1.0 + 1e-9)));
  if (bound > 1e-6 * grid.voxel()) {
    ASSERT_TRUE(grid.isFarther(p, bound * (1.0 - 1e-9) - 1e-9 * grid.voxel()));
  }
  counts.positive += bound > 0.0;
  counts.near += exact > 0.0 && exact < 4.0 * grid.voxel();
  counts.inside += exact == 0.0;
  (farther ? counts.farther : counts.unknown) += 1;
}

TEST(ClearanceGrid, NeverSaysMoreThanTheDistance) {
  std::mt19937 random(1);
  for (const ClearanceScene& scene : test::clearanceScenes()) {
    SCOPED_TRACE(scene.name);
    Counts counts;
    for (int round = 0; round < 6; ++round) {
      ClearanceGridOptions options;
      options.cells = round % 2 == 0 ? 4000 : 60'000;
      if (round >= 2) options.window = randomWindow(scene.shape, random);
      const ClearanceGrid grid = ClearanceGrid::build(scene.shape, options);
      for (int i = 0; i < 250; ++i) {
        judge(scene, grid, test::clearanceSample(scene, grid, random), random, counts);
        if (HasFatalFailure()) return;
      }
    }
    EXPECT_GT(counts.positive, 400);
    EXPECT_GT(counts.near, 200);
    EXPECT_GT(counts.farther, 100);
    EXPECT_GT(counts.unknown, 200);
    if (scene.solid) {
      EXPECT_GT(counts.inside, 100);
    }
  }
}

TEST(ClearanceGrid, NeverSaysMoreFromFarAway) {
  std::mt19937 random(2);
  for (const ClearanceScene& scene : test::clearanceScenes()) {
    SCOPED_TRACE(scene.name);
    const ClearanceGrid grid = ClearanceGrid::build(scene.shape, kFewCells);
    Counts counts;
    for (const double away : {1e3, 1e6, 1e9, 1e12}) {
      for (int i = 0; i < 20; ++i) {
        const Vector3d p = grid.box().center() + away * test::unitVector(random);
        judge(scene, grid, p, random, counts);
        if (HasFatalFailure()) return;
        // From as far the grid is as good as the shape.
        ASSERT_GE(grid.clearance(p), scene.distance(p) * (1.0 - 1e-12) - 20.0) << p.transpose();
      }
    }
  }
}

/// Where the bound has least to spare: a point in the corner of its cell that is next to the shape,
/// and the shape in the corner of a cell that is next to the point.
TEST(ClearanceGrid, NeverSaysMoreFromCornerToCorner) {
  constexpr double kWithin = 1.0 - 1e-6;  // of the way from the middle of a cell
  std::vector<Vector3d> points{Vector3d::Zero(), Vector3d(4.0, 4.1, 4.2)};
  const ClearanceGridOptions options{.window = ClearanceGridOptions().window, .cells = 60'000};
  const ClearanceGrid frame = ClearanceGrid::build(PointCloud::build(points, 0.0), options);
  const double side = 2.0 * frame.voxel();
  const Vector3d middle =
      frame.box().lower + side * Vector3d(20.5, 20.5, 20.5);  // of a cell in the middle of the box
  ASSERT_TRUE((frame.box().upper - middle).minCoeff() > 15.0 * side);
  points.emplace_back();
  for (int i = 0; i < 27; ++i) {
    if (i == 13) continue;
    const int y = i / 3 % 3, z = i / 9;
    const Vector3d towards(i % 3 - 1, y - 1, z - 1);
    const Vector3d p = middle + 0.5 * kWithin * side * towards;
    for (int cells = 2; cells < 10; ++cells) {
      points.back() = middle + (cells - 0.5 * kWithin) * side * towards;
      const ClearanceGrid grid = ClearanceGrid::build(PointCloud::build(points, 0.0), options);
      ASSERT_EQ(grid.box().lower, frame.box().lower);
      ASSERT_EQ(grid.voxel(), frame.voxel());
      const double exact = (points.back() - p).norm();
      ASSERT_LE(grid.clearance(p), exact) << towards.transpose() << ", " << cells << " cells";
      ASSERT_FALSE(grid.isFarther(p, exact)) << towards.transpose() << ", " << cells << " cells";
      EXPECT_GT(grid.clearance(p), 0.0);
    }
  }
}

/// Where an ulp is larger than a voxel, roundings are all that is between the bound and the truth.
TEST(ClearanceGrid, CountsRoundingsOfLargeCoordinates) {
  std::mt19937 random(3);
  int positive = 0;
  for (int i = 0; i < 2000; ++i) {
    const double reach = std::pow(10.0, uniform(random, 3.0, 20.0));
    const Vector3d center = test::uniformPoint(random, reach);
    const ClearanceGrid grid = ClearanceGrid::build(
        PointCloud::build(std::vector<Vector3d>{center}, 0.0), {.cells = 1000});
    const double away = std::pow(10.0, uniform(random, -15.0, 5.0));
    const Vector3d p = center + away * test::uniformPoint(random, reach);
    const Eigen::Matrix<long double, 3, 1> way = p.cast<long double>() - center.cast<long double>();
    ASSERT_LE(static_cast<long double>(grid.clearance(p)), way.norm()) << i;
    positive += grid.clearance(p) > 0.0;
  }
  EXPECT_GT(positive, 1000);
}

/// Everything beyond a face of the box where the window cut the shape off counts as the shape.
double distanceToCutFaces(const ClearanceGrid& grid, const Vector3d& p) {
  double least = kInfinity;
  for (int i = 0; i < 3; ++i) {
    if (std::isinf(grid.field()->lower[i])) least = std::min(least, p[i] - grid.box().lower[i]);
    if (std::isinf(grid.field()->upper[i])) least = std::min(least, grid.box().upper[i] - p[i]);
  }
  return least;
}

TEST(ClearanceGrid, SaysNotMuchLess) {
  std::mt19937 random(4);
  double less = 0.0;
  int all = 0, near = 0, cut = 0, saturated = 0;
  for (const ClearanceScene& scene : test::clearanceScenes()) {
    SCOPED_TRACE(scene.name);
    const bool isCloud = !scene.centers.empty();
    for (int round = 0; round < 4; ++round) {
      ClearanceGridOptions options;
      options.cells = round % 2 == 0 ? 4000 : 100'000;
      if (round >= 2) options.window = randomWindow(scene.shape, random);
      const ClearanceGrid grid = ClearanceGrid::build(scene.shape, options);
      const double voxel = grid.voxel();
      EXPECT_EQ(grid.error(), 9.0 * voxel);
      EXPECT_EQ(grid.reach(), 37.0 * voxel);
      for (int i = 0; i < 400; ++i) {
        const Vector3d p = test::clearanceSample(scene, grid, random);
        if (!grid.box().contains(p)) continue;
        const double toCut = distanceToCutFaces(grid, p);
        const double exact = std::min(scene.distance(p), toCut);
        const double rounding = 1e-11 * (p.lpNorm<1>() + grid.box().upper.lpNorm<1>());
        const double bound = grid.clearance(p) + rounding;
        ASSERT_GE(bound, std::min(exact - (isCloud ? 7.1 * voxel : grid.error()), grid.reach()));
        if (isCloud && exact < 4.0 * voxel) {
          ASSERT_GE(bound, exact - 3.5 * voxel) << p.transpose();
        }
        near += exact > 0.0 && exact < 4.0 * voxel;
        cut += toCut < 10.0 * voxel && toCut == exact;
        saturated += exact > grid.reach() + grid.error();
        if (exact == 0.0 || exact > grid.reach()) continue;
        ++all;
        less += (exact - grid.clearance(p)) / voxel;
      }
    }
  }
  EXPECT_GT(near, 3000);
  EXPECT_GT(cut, 300);
  EXPECT_LT(less / all, 3.0);
  EXPECT_GT(saturated, 20);
}

TEST(ClearanceGrid, BeyondTheBoxAddsTheDistanceFromIt) {
  std::mt19937 random(5);
  int beyond = 0;
  for (const ClearanceScene& scene : test::clearanceScenes()) {
    SCOPED_TRACE(scene.name);
    const ClearanceGrid grid = ClearanceGrid::build(scene.shape, kFewCells);
    const Aabb& box = grid.box();
    for (int i = 0; i < 100; ++i) {
      const Vector3d p = box.center() + uniform(random, 0.5, 9.0) * (box.upper - box.lower).norm() *
                                            test::unitVector(random);
      if (box.contains(p)) continue;
      ++beyond;
      const Vector3d nearest = p.cwiseMax(box.lower).cwiseMin(box.upper);
      const double least = std::hypot((p - nearest).norm(), grid.clearance(nearest));
      ASSERT_NEAR(grid.clearance(p), least, 1e-11 * (p.lpNorm<1>() + least)) << p.transpose();
    }
  }
  EXPECT_GT(beyond, 1000);
}

/// What the window cut off is beyond the grid, and the values must not say that nothing is there.
TEST(ClearanceGrid, CountsWhatTheWindowCutsOffAsOccupied) {
  const ClearanceScene scene =
      test::meshScene("", test::torusSoup(48, 24, 0.5, 0.2), MeshInterior::Solid);
  std::mt19937 random(12);
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const bool isLower = face % 2 == 0;
    SCOPED_TRACE(face);
    ClearanceGridOptions options;
    // Through the hole or beside the surface: what is cut off is what is nearest.
    const double at = axis == 2 ? -0.19 : 0.29;
    (isLower ? options.window.lower : options.window.upper)[axis] = isLower ? -at : at;
    const ClearanceGrid grid = ClearanceGrid::build(scene.shape, options);
    const detail::ClearanceField& field = *grid.field();
    EXPECT_TRUE(std::isinf((isLower ? field.lower : field.upper)[axis]));
    int positive = 0;
    for (int i = 0; i < 6000; ++i) {
      Vector3d middle;
      for (int k = 0; k < 3; ++k)
        middle[k] = 0.5 + std::uniform_int_distribution<int>(0, 4 * field.blocks[k] - 1)(random);
      // Half of them at the face.
      const auto off = static_cast<double>(random() % 6);
      if (i % 2 == 0) middle[axis] = isLower ? off + 0.5 : 4.0 * field.blocks[axis] - off - 0.5;
      const Vector3d p = field.origin + grid.voxel() * middle;
      const double bound = grid.clearance(p);
      if (bound == 0.0) continue;
      ASSERT_LE(bound, std::min(scene.distance(p), distanceToCutFaces(grid, p) + 1e-12));
      ++positive;
    }
    EXPECT_GT(positive, 1200);
  }
}

TEST(ClearanceGrid, WindowBesideTheShapeIsNoWindow) {
  const ClearanceScene scene = test::clearanceScenes().front();
  ClearanceGridOptions options = kFewCells;
  options.window = {Vector3d::Constant(5.0), Vector3d::Constant(6.0)};
  const ClearanceGrid beside = ClearanceGrid::build(scene.shape, options);
  const ClearanceGrid whole = ClearanceGrid::build(scene.shape, kFewCells);
  EXPECT_EQ(beside.box().lower, whole.box().lower);
  EXPECT_EQ(beside.box().upper, whole.box().upper);
  const Vector3d p(5.5, 5.2, 5.9);
  EXPECT_EQ(beside.clearance(p), whole.clearance(p));
  EXPECT_GT(beside.clearance(p), scene.distance(p) - 1.0);
}

TEST(ClearanceGrid, NoNumberIsNowhere) {
  const ClearanceGrid grid = ClearanceGrid::build(test::clearanceScenes().front().shape, kFewCells);
  for (const double bad : {std::nan(""), kInfinity, -kInfinity}) {
    for (int i = 0; i < 3; ++i) {
      Vector3d p(3.0, 3.0, 3.0);
      p[i] = bad;
      EXPECT_EQ(grid.clearance(p), 0.0);
      EXPECT_FALSE(grid.isFarther(p, 0.0));
    }
  }
  const Vector3d p(3.0, 3.0, 3.0);
  EXPECT_TRUE(grid.isFarther(p, 2.0));
  EXPECT_FALSE(grid.isFarther(p, std::nan("")));
  EXPECT_FALSE(grid.isFarther(p, kInfinity));
  for (const double away : {1e149, 1e151, 1e200, 1e308}) {
    for (const Vector3d& far : {Vector3d(away, 0.0, 0.0), Vector3d(-away, away, 1.0)}) {
      EXPECT_LE(grid.clearance(far), far.stableNorm());
      EXPECT_GE(grid.clearance(far), 0.33 * far.stableNorm());
      EXPECT_TRUE(grid.isFarther(far, 0.33 * away));
      EXPECT_FALSE(grid.isFarther(far, 1.5 * away));
    }
  }
}

TEST(ClearanceGrid, ManyAtOnceAreTheSameBitForBit) {
  std::mt19937 random(8);
  int positive = 0, asked = 0;
  for (const ClearanceScene& scene : test::clearanceScenes()) {
    SCOPED_TRACE(scene.name);
    for (int round = 0; round < 4; ++round) {
      ClearanceGridOptions options = kFewCells;
      if (round >= 2) options.window = randomWindow(scene.shape, random);
      const ClearanceGrid grid = ClearanceGrid::build(scene.shape, options);
      // Some blocks of eight have a point that is far, or none at all.
      std::vector<Vector3d> points;
      for (int i = 0; i < 203; ++i) {
        points.push_back(test::clearanceSample(scene, grid, random));
        if (i % 5 == 0) points.back() = grid.box().center() + 1e6 * test::unitVector(random);
        if (i % 50 == 0) points.back().y() = i % 100 == 0 ? 1e200 : std::nan("");
      }
      for (const std::int64_t target : simd_test::simdTargets()) {
        const simd_test::OnTarget on(target);
        std::vector<double> bounds(points.size(), -1.0);
        grid.clearances(points, bounds);
        for (std::size_t i = 0; i < points.size(); ++i) {
          ASSERT_EQ(bounds[i], grid.clearance(points[i])) << points[i].transpose();
          positive += bounds[i] > 0.0;
          ++asked;
        }
      }
    }
  }
  EXPECT_GT(positive, asked / 3);
  const ClearanceGrid grid = ClearanceGrid::build(test::clearanceScenes().front().shape, kFewCells);
  grid.clearances({}, {});
  std::vector<double> two(2);
  try {
    grid.clearances(std::vector<Vector3d>(3), two);
    ADD_FAILURE() << "taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "clearance grid: 3 points and 2 bounds");
  }
}

std::string messageOf(const Shape& shape, const ClearanceGridOptions& options) {
  return test::messageOf([&] { static_cast<void>(ClearanceGrid::build(shape, options)); });
}

TEST(ClearanceGrid, RefusesWhatItCannotBuild) {
  const Shape cloud = PointCloud::build(std::vector<Vector3d>(3, Vector3d(1.0, 2.0, 3.0)), 0.1);
  EXPECT_EQ(messageOf(Sphere{1.0}, {}),
            "clearance grid: the shape is of kind sphere; allowed: mesh, point cloud");
  EXPECT_EQ(messageOf(HalfSpace{Vector3d::UnitZ(), 0.0}, {}),
            "clearance grid: the shape is of kind half-space; allowed: mesh, point cloud");
  EXPECT_EQ(messageOf(cloud, {.cells = 999}),
            "clearance grid: 999 cells; allowed: 1000 to 134217728");
  EXPECT_EQ(messageOf(cloud, {.cells = 134217729}),
            "clearance grid: 134217729 cells; allowed: 1000 to 134217728");
  EXPECT_EQ(
      messageOf(cloud, {.window = {Vector3d(0.0, 0.0, 5.0), Vector3d(1.0, 1.0, 4.0)}}),
      "clearance grid: window is from (0, 0, 5) to (1, 1, 4); allowed: no lower coordinate above "
      "the upper");
  EXPECT_EQ(
      messageOf(cloud, {.window = {Vector3d(std::nan(""), 0.0, 0.0), Vector3d(1.0, 1.0, 4.0)}}),
      "clearance grid: window is from (nan, 0, 0) to (1, 1, 4); allowed: no lower coordinate above "
      "the upper");
  const Shape huge =
      PointCloud::build(std::vector<Vector3d>{Vector3d::Zero(), Vector3d(2e30, 0.0, 0.0)}, 0.1);
  EXPECT_EQ(messageOf(huge, {}),
            "clearance grid: the shape reaches 2e+30 m within the window; allowed: 1e+30");
  EXPECT_EQ(messageOf(huge, {.window = {Vector3d::Constant(-1.0), Vector3d::Constant(1.0)}}), "");
}

/// Voxels grow with the shape, also where the window is small: they became infinite, and a query
/// read at an index that was no number.
TEST(ClearanceGrid, ReachesFarBeyondTheWindowOrSaysThatItDoesNot) {
  const ClearanceGridOptions near{.window = {Vector3d::Constant(-1.0), Vector3d::Constant(1.0)}};
  for (const double reach : {1e20, 1e31, 1e39, 1e50, 1e100, 1e155, 1e300}) {
    const std::vector<Vector3d> points{Vector3d(0.5, 0.0, 0.0), Vector3d(reach, 0.0, 0.0)};
    const Shape cloud = PointCloud::build(points, 0.1);
    std::ostringstream refusal;
    if (reach > 1e40)
      refusal << "clearance grid: the shape reaches " << reach
              << " m; allowed: 1e+40, and within the window 1e+30";
    EXPECT_EQ(messageOf(cloud, near), refusal.str());
    if (reach > 1e40) continue;
    const ClearanceGrid grid = ClearanceGrid::build(cloud, near);
    for (const double x : {-1e151, -reach, -5.0, 0.0, 0.5, 1.0, reach, 1e151}) {
      const double clearance = grid.clearance(Vector3d(x, 0.0, 0.0));
      EXPECT_GE(clearance, 0.0);
      EXPECT_LE(clearance, std::max(0.0, std::min(std::abs(x - 0.5), std::abs(x - reach)) - 0.1));
    }
  }
}

TEST(ClearanceGrid, QueriesAllocateNothingAndCopiesShare) {
  std::mt19937 random(6);
  const ClearanceScene scene = test::clearanceScenes().front();
  const ClearanceGrid grid = ClearanceGrid::build(scene.shape, kFewCells);
  const long before = test::allocations;
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): what a copy costs is asked here.
  const ClearanceGrid copy = grid;
  double sum = 0.0;
  std::array<Vector3d, 16> points;
  std::array<double, 16> bounds;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d p = test::uniformPoint(random, 1.0);
    sum += copy.clearance(p) + (grid.isFarther(p, 0.1) ? 1.0 : 0.0);
    points.fill(p);
    grid.clearances(points, bounds);
    sum += bounds.back();
  }
  EXPECT_EQ(test::allocations, before);
  EXPECT_GT(sum, 0.0);
  EXPECT_EQ(copy.field(), grid.field());
  EXPECT_GT(grid.bytes(), 1000u);
  EXPECT_LT(grid.bytes(), 100'000u);
}

}  // namespace
}  // namespace swept
