// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "all_volumes.hpp"
#include "mesh_samples.hpp"
#include "swept/core/bv/aabb.hpp"
#include "swept/core/bv/bounding_volume.hpp"
#include "swept/core/bv/kdop.hpp"
#include "swept/core/bv/obb.hpp"
#include "swept/core/bv/obb_rss.hpp"
#include "swept/core/bv/rss.hpp"
#include "swept/core/distance.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

/// Points of a box of random proportions, turned and moved.
Points randomPoints(std::mt19937& random, std::size_t count, double size = 1.0) {
  const Vector3d half{test::uniform(random, 0.05, 1.0), test::uniform(random, 0.05, 1.0),
                      test::uniform(random, 0.05, 1.0)};
  const Isometry3d pose = test::randomPose(random, 1.0);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back(size * (pose * half.cwiseProduct(test::uniformPoint(random, 1.0))));
  }
  return points;
}

/// All kinds of sets a primitive or a subtree can be, near the origin and far from it.
std::vector<Points> allKinds(std::mt19937& random) {
  std::vector<Points> sets;
  for (const double scale : {1e-6, 1.0, 1e6}) {
    for (const double offset : {0.0, 1.0, 1e3}) {
      const Vector3d at = scale * offset * test::unitVector(random);
      const Vector3d u = test::unitVector(random);
      const Vector3d v = test::unitVector(random);
      sets.push_back({at});
      sets.push_back({at, at, at});
      Points line;
      Points plane;
      Points sliver;
      for (int i = 0; i < 20; ++i) {
        const double s = test::uniform(random, -scale, scale);
        const double t = test::uniform(random, -scale, scale);
        line.push_back(at + s * u);
        plane.push_back(at + s * u + t * v);
        sliver.push_back(at + s * u + 1e-9 * t * v);
      }
      sets.insert(sets.end(), {line, plane, sliver, {at, at + scale * u, at + 0.3 * scale * v}});
      for (const std::size_t count : {4U, 6U, 50U, 300U}) {
        Points cloud = randomPoints(random, count, scale);
        for (Vector3d& p : cloud) p += at;
        sets.push_back(cloud);
      }
    }
  }
  return sets;
}

Points moved(const Points& points, const Isometry3d& by) {
  Points out;
  for (const Vector3d& p : points) out.push_back(by * p);
  return out;
}

double leastDistance(const Points& a, const Points& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& p : a) {
    for (const Vector3d& q : b) least = std::min(least, (p - q).norm());
  }
  return least;
}

Vector3d randomMix(std::mt19937& random, const Points& points) {
  Vector3d sum = Vector3d::Zero();
  double weights = 0.0;
  for (const Vector3d& p : points) {
    const double w = -std::log(test::uniform(random, 1e-9, 1.0));
    sum += w * p;
    weights += w;
  }
  return sum / weights;
}

template <typename BV>
class BoundingVolumes : public testing::Test {};
TYPED_TEST_SUITE(BoundingVolumes, test::AllVolumes);

TYPED_TEST(BoundingVolumes, FitContainsEveryPoint) {
  std::mt19937 random(1);
  for (const Points& points : allKinds(random)) {
    const TypeParam volume = TypeParam::fit(points);
    for (const Vector3d& p : points) EXPECT_TRUE(volume.contains(p)) << p.transpose();
  }
}

TYPED_TEST(BoundingVolumes, FitIsTight) {
  // No box around a ball of points is larger than a few times the ball.
  std::mt19937 random(2);
  for (const double scale : {1e-6, 1.0, 1e6}) {
    Points points;
    for (int i = 0; i < 500; ++i) points.push_back(scale * test::unitVector(random));
    const TypeParam volume = TypeParam::fit(points);
    EXPECT_LT(std::sqrt(volume.size()), 2.0 * std::sqrt(3.0) * 1.1 * scale);
    EXPECT_LT(Vector3d(volume.center()).norm(), 0.2 * scale);
    EXPECT_FALSE(volume.contains(Vector3d(2.0 * scale, 0.0, 0.0)));
  }
}

TYPED_TEST(BoundingVolumes, MergeContainsBoth) {
  std::mt19937 random(3);
  const std::vector<Points> sets = allKinds(random);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (const std::size_t j : {i, (i + 1) % sets.size(), (i + 7) % sets.size()}) {
      const TypeParam merged = TypeParam::merge(TypeParam::fit(sets[i]), TypeParam::fit(sets[j]));
      for (const Vector3d& p : sets[i]) EXPECT_TRUE(merged.contains(p)) << i << ' ' << j;
      for (const Vector3d& p : sets[j]) EXPECT_TRUE(merged.contains(p)) << i << ' ' << j;
    }
  }
}

TYPED_TEST(BoundingVolumes, MergeStaysContainingWhenRepeated) {
  // As in a hierarchy: merges of merges, 16 levels.
  std::mt19937 random(4);
  Points all = randomPoints(random, 4);
  TypeParam volume = TypeParam::fit(all);
  for (int level = 0; level < 16; ++level) {
    const Points more = randomPoints(random, 4);
    volume = TypeParam::merge(volume, TypeParam::fit(more));
    all.insert(all.end(), more.begin(), more.end());
    for (const Vector3d& p : all) ASSERT_TRUE(volume.contains(p)) << level;
  }
  EXPECT_LT(std::sqrt(volume.size()), 60.0);
}

TYPED_TEST(BoundingVolumes, InflatedContainsTheNeighbourhood) {
  std::mt19937 random(5);
  for (const Points& points : allKinds(random)) {
    const double by = test::uniform(random, 0.0, 1.0);
    const TypeParam volume = TypeParam::fit(points).inflated(by);
    for (const Vector3d& p : points) {
      const Vector3d near = p + by * (1.0 - 1e-12) * test::unitVector(random);
      if ((near - p).norm() <= by) {
        EXPECT_TRUE(volume.contains(near));
      }
    }
  }
}

TYPED_TEST(BoundingVolumes, OverlapNeverMissesACommonPoint) {
  std::mt19937 random(6);
  const std::vector<Points> sets = allKinds(random);
  for (int i = 0; i < 4000; ++i) {
    const Points& a = sets[random() % sets.size()];
    const Points& b = sets[random() % sets.size()];
    Isometry3d a_from_b = test::randomPose(random, 1.0);
    if (i % 4 == 0) a_from_b.linear().setIdentity();
    // A point of each hull, or a corner of it, brought together.
    const bool corner = i % 2 == 0;
    const Vector3d p = corner ? a[random() % a.size()] : randomMix(random, a);
    const Vector3d q = corner ? b[random() % b.size()] : randomMix(random, b);
    a_from_b.translation() = p - a_from_b.linear() * q;
    const TypeParam first = TypeParam::fit(a);
    const TypeParam second = TypeParam::fit(b);
    EXPECT_TRUE(first.overlaps(second, a_from_b)) << i;
    EXPECT_TRUE(second.overlaps(first, a_from_b.inverse())) << i;
    // The tiny rest is the rounding of the pose itself.
    EXPECT_LE(first.distanceBound(second, a_from_b), 0.0) << i;
    if (corner) {
      const Points there = moved(b, a_from_b);
      EXPECT_TRUE(first.overlaps(TypeParam::fit(there).inflated(
          1e-15 * (p.template lpNorm<1>() + a_from_b.translation().template lpNorm<1>()))));
    }
  }
}

TYPED_TEST(BoundingVolumes, OverlapIsSymmetricAndOftenFalse) {
  std::mt19937 random(7);
  int overlapping = 0;
  constexpr int kPairs = 2000;
  for (int i = 0; i < kPairs; ++i) {
    const TypeParam a = TypeParam::fit(randomPoints(random, 30));
    const TypeParam b = TypeParam::fit(randomPoints(random, 30));
    const Isometry3d a_from_b = test::randomPose(random, 1.0);
    const bool overlap = a.overlaps(b, a_from_b);
    EXPECT_EQ(overlap, b.overlaps(a, a_from_b.inverse()));
    EXPECT_EQ(a.overlaps(b), b.overlaps(a));
    if (a.overlaps(b)) {
      EXPECT_TRUE(a.overlaps(b, Isometry3d::Identity()));
    }
    overlapping += overlap;
  }
  EXPECT_GT(overlapping, 0.3 * kPairs);
  EXPECT_LT(overlapping, 0.7 * kPairs);
}

TYPED_TEST(BoundingVolumes, DistanceBoundIsBelowTheDistanceAndGrowsLikeIt) {
  std::mt19937 random(8);
  int positive = 0;
  double worst = 1.0;
  constexpr int kPairs = 1000;
  for (int i = 0; i < kPairs; ++i) {
    const double scale = std::pow(10.0, test::uniform(random, -6.0, 6.0));
    const Points a = randomPoints(random, 40, scale);
    const Points b = randomPoints(random, 40, scale);
    const TypeParam first = TypeParam::fit(a);
    const TypeParam second = TypeParam::fit(b);
    Isometry3d a_from_b = test::randomPose(random, 0.0);
    const Vector3d away = test::unitVector(random);
    a_from_b.translation() = test::uniform(random, 0.3, 4.0) * scale * away;
    const double near = first.distanceBound(second, a_from_b);
    EXPECT_LE(near, leastDistance(a, moved(b, a_from_b)));
    a_from_b.translation() = 15.0 * scale * away;
    const double far = first.distanceBound(second, a_from_b);
    const double distance = leastDistance(a, moved(b, a_from_b));
    EXPECT_LE(far, distance);
    positive += near > 0.0;
    worst = std::min(worst, far / distance);
  }
  EXPECT_GT(positive, 0.3 * kPairs);
  EXPECT_LT(positive, 0.9 * kPairs) << "only far pairs: the near ones test the bound";
  // At 15 times the size of the sets no volume wastes more than a third of the distance.
  EXPECT_GT(worst, 0.66);
}

TYPED_TEST(BoundingVolumes, WhatIsNotFiniteFailsSafe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const Points fine{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const TypeParam good = TypeParam::fit(fine);
  Isometry3d far = Isometry3d::Identity();
  far.translation().x() = 1e3;
  ASSERT_FALSE(good.overlaps(good, far));
  ASSERT_GT(good.distanceBound(good, far), 990.0);
  std::vector<TypeParam> bad{TypeParam::fit({})};
  for (const double value : {nan, infinity, -infinity}) {
    for (std::size_t i = 0; i < fine.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        Points points = fine;
        points[i][k] = value;
        bad.push_back(TypeParam::fit(points));
      }
    }
    for (int k = 0; k < 3; ++k) {
      Isometry3d pose = far;
      pose.translation()[k] = value;
      EXPECT_TRUE(good.overlaps(good, pose));
      EXPECT_EQ(good.distanceBound(good, pose), 0.0);
    }
  }
  Isometry3d pose = far;
  pose.linear().setConstant(nan);
  EXPECT_TRUE(good.overlaps(good, pose));
  EXPECT_EQ(good.distanceBound(good, pose), 0.0);
  for (const TypeParam& each : bad) {
    for (const TypeParam& volume :
         {each, TypeParam::merge(good, each), TypeParam::merge(each, good), each.inflated(1.0)}) {
      EXPECT_TRUE(volume.contains({5, 5, 5}));
      EXPECT_TRUE(good.overlaps(volume, far));
      EXPECT_TRUE(volume.overlaps(good, far));
      EXPECT_TRUE(volume.overlaps(good));
      EXPECT_TRUE(good.overlaps(volume));
      EXPECT_EQ(volume.distanceBound(good, far), 0.0);
      EXPECT_EQ(good.distanceBound(volume, far), 0.0);
    }
  }
}

/// Squares of small numbers underflow, or keep a few of their digits: bounds were up to twice the
/// distance, and points beyond what should contain them.
TYPED_TEST(BoundingVolumes, SizesMayBeExtreme) {
  std::mt19937 random(9);
  for (const double exponent :
       {-319.0, -310.0, -300.0, -170.0, -162.0, -161.8, -161.0, -160.0, -155.0, -150.0, -77.0,
        77.0,   100.0,  150.0,  153.9,  154.1,  155.0,  160.0,  200.0,  300.0,  307.0}) {
    const double scale = std::pow(10.0, exponent);
    for (int i = 0; i < 200; ++i) {
      const Points a = randomPoints(random, 1 + i % 8, scale);
      const Points b = randomPoints(random, 1 + i % 8, scale);
      const TypeParam first = TypeParam::fit(a), second = TypeParam::fit(b);
      const TypeParam both = TypeParam::merge(first, second);
      for (const Vector3d& p : a) ASSERT_TRUE(first.contains(p) && both.contains(p)) << scale;
      for (const Vector3d& p : b) ASSERT_TRUE(second.contains(p) && both.contains(p)) << scale;
      Isometry3d a_from_b = test::randomPose(random, 0.0);
      a_from_b.translation() = a.front() - a_from_b.linear() * b.front();
      ASSERT_TRUE(first.overlaps(second, a_from_b)) << scale;
      a_from_b.translation() = 3.0 * scale * test::uniformPoint(random, 1.0);
      double least = std::numeric_limits<double>::infinity();
      for (const Vector3d& p : a) {
        for (const Vector3d& q : moved(b, a_from_b))
          least = std::min(least, std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z()));
      }
      ASSERT_LE(first.distanceBound(second, a_from_b), least) << scale;
    }
  }
}

/// The sharp claims of single volumes, against queries of solids.

TEST(Obb, FifteenAxesDecideAsTheBoxesDo) {
  std::mt19937 random(9);
  int apart = 0;
  constexpr int kPairs = 1500;
  for (int i = 0; i < kPairs; ++i) {
    const Obb a = Obb::fit(randomPoints(random, 30));
    const Obb b = Obb::fit(randomPoints(random, 30));
    const Isometry3d a_from_b = test::randomPose(random, 1.1);
    const auto poseOf = [](const Obb& box) {
      Isometry3d pose = Isometry3d::Identity();
      pose.linear() = box.axes;
      if (box.axes.determinant() < 0.0) pose.linear().col(2) *= -1.0;
      pose.translation() = box.center();
      return pose;
    };
    const Isometry3d boxA_from_boxB = poseOf(a).inverse() * a_from_b * poseOf(b);
    const DistanceResult d = distance(Box{a.halfExtents}, Box{b.halfExtents}, boxA_from_boxB);
    const bool overlap = a.overlaps(b, a_from_b);
    if (d.lower > 1e-9) {
      EXPECT_FALSE(overlap) << i;
    }
    if (d.upper == 0.0) {
      EXPECT_TRUE(overlap) << i;
    }
    const double bound = a.distanceBound(b, a_from_b);
    EXPECT_LE(bound, d.upper);
    if (d.lower > 1e-9) {
      EXPECT_GE(bound, 0.57 * d.lower) << i;
    }
    apart += d.lower > 1e-9;
  }
  EXPECT_GT(apart, 0.3 * kPairs);
  EXPECT_LT(apart, 0.7 * kPairs);
}

TEST(Rss, BoundIsTheDistanceOfTheSweptRectangles) {
  std::mt19937 random(10);
  int apart = 0;
  constexpr int kPairs = 1500;
  for (int i = 0; i < kPairs; ++i) {
    const Rss a = Rss::fit(randomPoints(random, 30));
    const Rss b = Rss::fit(randomPoints(random, 30));
    const Isometry3d a_from_b = test::randomPose(random, 1.1);
    const auto rectangle = [](const Rss& rss) {
      Points corners;
      for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
          corners.push_back(rss.middle + x * rss.halfLengths.x() * rss.axes.col(0) +
                            y * rss.halfLengths.y() * rss.axes.col(1));
        }
      }
      return ConvexHull::of(corners);
    };
    const double gap = distance(rectangle(a), rectangle(b), a_from_b).upper - a.radius - b.radius;
    const double bound = a.distanceBound(b, a_from_b);
    EXPECT_LE(bound, std::max(0.0, gap));
    if (gap > 1e-6) {
      EXPECT_GE(bound, (1.0 - 2e-3) * gap) << i;
    }
    if (std::abs(gap) > 1e-6) {
      EXPECT_EQ(a.overlaps(b, a_from_b), gap < 0.0) << i;
    }
    apart += gap > 0.0;
  }
  EXPECT_GT(apart, 0.3 * kPairs);
  EXPECT_LT(apart, 0.7 * kPairs);
}

TEST(KDop, MoreSlabsAreTighter) {
  std::mt19937 random(11);
  int disjoint16 = 0, disjoint18 = 0, disjoint24 = 0;
  for (int i = 0; i < 3000; ++i) {
    const Points a = randomPoints(random, 30);
    const Points b = randomPoints(random, 30);
    const bool d16 = !KDop<16>::fit(a).overlaps(KDop<16>::fit(b));
    const bool d18 = !KDop<18>::fit(a).overlaps(KDop<18>::fit(b));
    const bool d24 = !KDop<24>::fit(a).overlaps(KDop<24>::fit(b));
    EXPECT_LE(d16, d18);
    EXPECT_LE(d18, d24);
    disjoint16 += d16;
    disjoint18 += d18;
    disjoint24 += d24;
  }
  EXPECT_LT(disjoint16, disjoint18);
  EXPECT_LT(disjoint18, disjoint24);
}

TEST(Aabb, OverlapInOneFrameIsExact) {
  const Aabb a{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(a.overlaps(Aabb{{1, 0, 0}, {2, 1, 1}}));
  EXPECT_FALSE(a.overlaps(Aabb{{std::nextafter(1.0, 2.0), 0, 0}, {2, 1, 1}}));
  EXPECT_EQ(a.distanceBound(Aabb{{4, 5, 0}, {6, 6, 1}}, Isometry3d::Identity()) > 4.999999, true);
}

}  // namespace
}  // namespace swept
