// SPDX-License-Identifier: BSD-3-Clause
#include "point_cloud/cloud_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "mesh_samples.hpp"
#include "point_cloud/cloud_hull.hpp"
#include "point_cloud/curve_order.hpp"
#include "point_cloud/hilbert_curve.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/point_cloud.hpp"
#include "threads/crew.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

Points uniformPoints(std::mt19937& random, int count) {
  Points points;
  for (int i = 0; i < count; ++i) points.push_back(test::uniformPoint(random, 1.0));
  return points;
}

/// On a turned box's surface, with noise: what a sensor sees of a room.
Points wallPoints(std::mt19937& random, int count) {
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond(0.9, 0.2, 0.3, 0.1).normalized().toRotationMatrix();
  Points points;
  for (int i = 0; i < count; ++i) {
    Vector3d p = test::uniformPoint(random, 1.0);
    p[i % 3] = p[i % 3] < 0.0 ? -1.0 : 1.0;
    points.push_back(turn * (p + 0.003 * test::uniformPoint(random, 1.0)));
  }
  return points;
}

Points spherePoints(std::mt19937& random, int count) {
  Points points;
  while (points.size() < static_cast<std::size_t>(count)) {
    const Vector3d p = test::uniformPoint(random, 1.0);
    if (p.norm() > 0.1) points.push_back(p.normalized());
  }
  return points;
}

/// Thousands of points in a place that a grid over all of them has one cell for.
Points clusterPoints(std::mt19937& random, int count) {
  Points points = uniformPoints(random, count);
  for (Vector3d& p : points) p = Vector3d(0.3, -0.2, 0.1) + 1e-7 * p;
  points.emplace_back(100.0, 50.0, -70.0);
  return points;
}

Points all(const std::vector<int>& order, const Points& points) {
  Points result;
  for (const int i : order) result.push_back(points[static_cast<std::size_t>(i)]);
  return result;
}

std::vector<int> orderOf(const Points& points, unsigned threads = 1) {
  Crew crew(threads);
  return curveOrder(points, Aabb::fit(points), crew);
}

Points ordered(const Points& points) {
  return all(orderOf(points), points);
}

/// m, of the boxes of runs of eight.
double medianBucket(const Points& points) {
  std::vector<double> sizes;
  for (std::size_t i = 0; i + 8 <= points.size(); i += 8) {
    const Aabb box = Aabb::fit(std::span(points).subspan(i, 8));
    sizes.push_back((box.upper - box.lower).norm());
  }
  std::ranges::nth_element(sizes, sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2));
  return sizes[sizes.size() / 2];
}

std::uint64_t indexOf(std::uint32_t x, std::uint32_t y, std::uint32_t z, int bits) {
  return HilbertCurve::indices<1>({HilbertCurve::cell(x, y, z)}, bits)[0];
}

TEST(HilbertCurve, PassesEveryCellOnceFromFaceToFace) {
  for (const int bits : {2, 4}) {
    const std::uint32_t side = 1U << bits;
    std::vector<Eigen::Array3i> cells(std::size_t{1} << (3 * bits), Eigen::Array3i(-1, -1, -1));
    for (std::uint32_t x = 0; x < side; ++x) {
      for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t z = 0; z < side; ++z) {
          const std::uint64_t index = indexOf(x, y, z, bits);
          ASSERT_LT(index, cells.size());
          EXPECT_EQ(cells[index].x(), -1);
          cells[index] =
              Eigen::Array3i(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z));
        }
      }
    }
    for (std::size_t i = 1; i < cells.size(); ++i) {
      EXPECT_EQ((cells[i] - cells[i - 1]).abs().sum(), 1) << i;
    }
  }
}

TEST(HilbertCurve, FinerCurvesRefineCoarserOnes) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const auto coordinate = [&] { return static_cast<std::uint32_t>(random() >> 16); };
    const std::uint32_t x = coordinate(), y = coordinate(), z = coordinate();
    EXPECT_EQ(indexOf(x, y, z, 16) >> 24, indexOf(x >> 8, y >> 8, z >> 8, 8));
  }
}

TEST(CurveOrder, IsAPermutationWhoseRunsAreCompact) {
  std::mt19937 random(2);
  const Points points = uniformPoints(random, 40000);
  std::vector<int> order = orderOf(points);
  // 5000 buckets share a volume of 8: the diagonal of a cube of that share is 0.2.
  EXPECT_LT(medianBucket(all(order, points)), 0.3);
  EXPECT_GT(medianBucket(points), 1.0);
  std::ranges::sort(order);
  for (std::size_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], static_cast<int>(i));
}

TEST(CurveOrder, DividesCrowdsByTheirOwnSize) {
  std::mt19937 random(3);
  const Points points = clusterPoints(random, 40000);
  EXPECT_LT(medianBucket(ordered(points)), 0.3e-7);
  EXPECT_GT(medianBucket(points), 1e-7);
}

TEST(CurveOrder, TakesAnyFiniteCoordinates) {
  std::mt19937 random(4);
  constexpr double kGreatest = std::numeric_limits<double>::max();
  for (const double scale : {kGreatest, 1e300, 1e-300, 1e-320}) {
    Points points = uniformPoints(random, 3000);
    for (Vector3d& p : points) p *= scale;
    points.front() = Vector3d::Constant(scale);
    points.back() = Vector3d::Constant(-scale);
    std::vector<int> order = orderOf(points);
    std::ranges::sort(order);
    for (std::size_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], static_cast<int>(i));
  }
  const Points same(1000, Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(ordered(same).size(), same.size());
}

/// Walks all of a hierarchy: every ball is in every box above it, and is a leaf once.
class Check {
 public:
  Check(const WideBvh& bvh, const PointBuckets& balls)
      : bvh_(bvh), balls_(balls), seen_(balls.points.size(), 0) {}

  void run() {
    const auto [first, last] = visit(0);
    EXPECT_EQ(last - first, balls_.points.size());
    EXPECT_TRUE(std::ranges::all_of(seen_, [](int n) { return n == 1; }));
    expectInside(bvh_.rootBox(), {0, balls_.points.size()});
    for (std::size_t i = 0; i < balls_.points.size(); ++i) {
      const Vector3d radius = Vector3d::Constant(balls_.radiusOf(i));
      EXPECT_TRUE(((balls_.points[i] - radius).array() >= bvh_.bounds().lower.array()).all());
      EXPECT_TRUE(((balls_.points[i] + radius).array() <= bvh_.bounds().upper.array()).all());
    }
  }

 private:
  using Run = std::pair<std::size_t, std::size_t>;  // points of a node are consecutive

  Run visit(std::int32_t index) {
    WideNode room;
    const WideNode& node = bvh_.node(index, room);
    EXPECT_GE(node.count, 1);
    EXPECT_LE(node.count, WideNode::kLanes);
    Run all{balls_.points.size(), 0};
    for (int lane = 0; lane < node.count; ++lane) {
      const std::int32_t child = node.child[lane];
      Run run;
      if (child >= 0) {
        run = visit(child);
      } else {
        const auto point = static_cast<std::size_t>(-1 - child);
        run = {point, point + 1};
        ++seen_[point];
      }
      expectInside(node.box(lane), run);
      expectWithinReach(node, lane);
      all = {std::min(all.first, run.first), std::max(all.second, run.second)};
    }
    return all;
  }

  void expectInside(const OrientedBox& box, const Run& run) {
    for (std::size_t i = run.first; i < run.second; ++i) {
      for (int j = 0; j < 3; ++j) {
        const Vector3d axis(box.axes[j][0], box.axes[j][1], box.axes[j][2]);
        const double height = std::abs(axis.dot(balls_.points[i] - box.center));
        EXPECT_LE(height + balls_.radiusOf(i), static_cast<double>(box.half[j]));
      }
    }
  }

  void expectWithinReach(const WideNode& node, int lane) {
    double size = 0.0;
    for (int i = 0; i < 3; ++i) {
      size += std::abs(static_cast<double>(node.center[i][lane])) +
              static_cast<double>(node.half[i][lane]);
    }
    EXPECT_LE(size, static_cast<double>(node.reach));
  }

  const WideBvh& bvh_;
  const PointBuckets& balls_;
  std::vector<int> seen_;
};

void check(Points points, double radius, std::mt19937* randomRadii = nullptr) {
  points = ordered(points);
  std::vector<double> radii;
  if (randomRadii != nullptr) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (std::size_t i = 0; i < points.size(); ++i) radii.push_back(radius * share(*randomRadii));
  }
  const PointBuckets balls{points, radii, radius};
  Crew alone(1);
  Check(CloudTree(balls, alone).bvh(), balls).run();
}

TEST(CloudTree, BoxesContainTheBalls) {
  std::mt19937 random(5);
  for (const int count : {1, 7, 8, 9, 64, 65, 512, 513, 5000}) {
    check(wallPoints(random, count), 0.01);
    check(wallPoints(random, count), 0.05, &random);
  }
  check(clusterPoints(random, 3000), 1e-8);
  Points far = uniformPoints(random, 3000);
  for (Vector3d& p : far) p = 1e-3 * p + Vector3d(1e6, -2e6, 3e6);
  check(far, 0.0);
  Points huge = uniformPoints(random, 1000);
  for (Vector3d& p : huge) p *= 1e31;
  check(huge, 1.0);
  Points tiny = uniformPoints(random, 1000);
  for (Vector3d& p : tiny) p *= 1e-310;
  check(tiny, 0.0);
}

/// Everything that queries read.
std::string bytesOf(const WideBvh& bvh) {
  std::string bytes;
  const auto add = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const WideNode& node : bvh.nodes()) {
    add(node.center);
    add(node.axes);
    add(node.half);
    add(node.child);
    for (const double at : node.origin) add(at);
    add(node.reach);
    add(node.count);
  }
  return bytes;
}

/// Of more pieces than threads, with a last one that is short.
TEST(CloudTree, IsTheSameForAnyNumberOfThreads) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> radius(0.001, 0.01);
  const Points points = wallPoints(random, 70'003);
  const std::vector<int> order = orderOf(points);
  const Points sorted = all(order, points);
  std::vector<double> radii;
  for (std::size_t i = 0; i < sorted.size(); ++i) radii.push_back(radius(random));
  Crew alone(1);
  const PointBuckets balls{sorted, radii, 0.01};
  const std::string truth = bytesOf(CloudTree(balls, alone).bvh());
  EXPECT_GT(truth.size(), 500'000U);
  for (const unsigned threads : {2U, 3U, 8U}) {
    Crew crew(threads);
    EXPECT_EQ(orderOf(points, threads), order);
    EXPECT_EQ(bytesOf(CloudTree(balls, crew).bvh()), truth);
  }
}

TEST(CloudTree, FindsTheFarthestPoint) {
  std::mt19937 random(6);
  for (const int count : {1, 100, 5000}) {
    const Points points = ordered(wallPoints(random, count));
    Crew alone(1);
    const CloudTree tree({points, {}, 0.0}, alone);
    for (int i = 0; i < 200; ++i) {
      const Vector3d d = test::uniformPoint(random, 1.0);
      double truth = -std::numeric_limits<double>::infinity();
      for (const Vector3d& p : points) truth = std::max(truth, d.dot(p));
      EXPECT_EQ(tree.support(d), truth);
    }
  }
}

/// Contains the points, and reaches at most `beyond` of their size farther.
void checkHull(const Points& given, double beyond) {
  const Points points = ordered(given);
  Crew alone(1);
  const CloudTree tree({points, {}, 0.0}, alone);
  const ConvexHull hull = cloudHull(points, tree);
  EXPECT_LE(hull.vertices().size(), points.size() > ConvexHull::kFew ? 300U : ConvexHull::kFew);
  double farthest = 0.0;
  for (const Vector3d& p : points) {
    const Eigen::Isometry3d at(Eigen::Translation3d(-p));
    farthest = std::max(farthest, distance(Sphere{0.0}, hull, at).lower);
  }
  EXPECT_EQ(farthest, 0.0);
  std::mt19937 random(7);
  const double size = (tree.bounds().upper - tree.bounds().lower).norm();
  for (int i = 0; i < 100; ++i) {
    const Vector3d d = test::uniformPoint(random, 1.0).normalized();
    double most = -std::numeric_limits<double>::infinity();
    for (const Vector3d& vertex : hull.vertices()) most = std::max(most, d.dot(vertex));
    EXPECT_LE(most, tree.support(d) + beyond * size);
  }
}

TEST(CloudHull, ContainsThePointsAndIsNear) {
  std::mt19937 random(8);
  checkHull(uniformPoints(random, 300), 1e-9);  // the hull itself
  checkHull(uniformPoints(random, 5000), 0.06);
  checkHull(wallPoints(random, 5000), 0.06);
  checkHull(spherePoints(random, 5000), 0.06);
  checkHull(clusterPoints(random, 5000), 0.06);
  Points needle = uniformPoints(random, 5000);
  for (Vector3d& p : needle) p = p.cwiseProduct(Vector3d(1.0, 1e-4, 1e-5));
  checkHull(needle, 0.2);
  Points disk = spherePoints(random, 5000);
  for (Vector3d& p : disk) p.z() = 0.0;
  checkHull(disk, 0.06);
  Points line = uniformPoints(random, 5000);
  for (Vector3d& p : line) p = p.x() * Vector3d(1.0, 2.0, 3.0);
  checkHull(line, 0.06);
  checkHull(Points(1000, Vector3d(1.0, 2.0, 3.0)), 0.0);
}

TEST(PointCloud, TakesFewBytes) {
  std::mt19937 random(9);
  const Points points = wallPoints(random, 20000);
  EXPECT_LT(PointCloud::build(points, 0.01).bytes(), 40 * points.size());
  std::vector<double> radii(points.size(), 0.01);
  EXPECT_LT(PointCloud::build(points, radii).bytes(), 40 * points.size());
  radii.front() = 0.02;
  EXPECT_LT(PointCloud::build(points, radii).bytes(), 48 * points.size());
}

TEST(PointCloud, DistanceIsThatOfTheNearestOfThousandsOfPoints) {
  std::mt19937 random(10);
  int near = 0;
  for (const Points& points : {wallPoints(random, 4000), clusterPoints(random, 4000)}) {
    const PointCloud cloud = PointCloud::build(points, 0.01);
    for (int i = 0; i < 200; ++i) {
      const Vector3d p = points[random() % points.size()] + 0.1 * test::uniformPoint(random, 1.0);
      double truth = std::numeric_limits<double>::infinity();
      for (const Vector3d& point : points) truth = std::min(truth, (p - point).norm());
      const Eigen::Isometry3d at{Eigen::Translation3d(p)};
      const DistanceResult found = distance(cloud, Sphere{0.01}, at);
      const double gap = std::max(0.0, truth - 0.02);
      EXPECT_LE(found.lower, gap + 1e-12);
      EXPECT_GE(found.upper, gap - 1e-12);
      EXPECT_LE(found.upper - found.lower, 1e-9);
      near += gap > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(near, 100);
}

}  // namespace
}  // namespace swept::detail
