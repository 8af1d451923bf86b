// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/segment_query.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cover_samples.hpp"
#include "simd_targets.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;
using test::uniform;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Least of a convex function on [-1, 1], or a little more.
template <typename Function>
double leastOn(const Function& function) {
  double low = -1.0;
  double high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    (function(a) < function(b) ? high : low) = function(a) < function(b) ? b : a;
  }
  return std::min({function(-1.0), function(1.0), function(0.5 * (low + high))});
}

double bruteForce(const TriangleMesh& mesh, const LineSegment& segment) {
  double nearest = kInfinity;
  for (const auto& t : reference::trianglesOf(mesh.vertices(), mesh.triangles())) {
    nearest = std::min(nearest, leastOn([&](double s) {
                         return reference::pointTriangle(segment.center + s * segment.half, t);
                       }));
  }
  return nearest;
}

double bruteForce(const PointCloud& cloud, const LineSegment& segment) {
  double nearest = kInfinity;
  for (std::size_t i = 0; i < cloud.points().size(); ++i) {
    const Vector3d& point = cloud.points()[i];
    const double toPoint =
        leastOn([&](double s) { return (segment.center + s * segment.half - point).norm(); });
    nearest = std::min(nearest, toPoint - cloud.radius(i));
  }
  return std::max(nearest, 0.0);
}

TriangleMesh triangles(std::mt19937& random, const Vector3d& offset) {
  const test::Soup soup = test::sliverSoup(random, 60, offset);
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

PointCloud points(std::mt19937& random, const Vector3d& offset, double radius) {
  std::vector<Vector3d> points;
  std::vector<double> radii;
  for (int i = 0; i < 60; ++i) {
    points.push_back(offset + test::uniformPoint(random, 1.0));
    radii.push_back(test::uniform(random, 0.0, 1.0) * radius);
  }
  return PointCloud::build(points, radii);
}

/// How far below the truth `radius` may have to be for a proof: a little more than what the boxes
/// in single precision need.
constexpr double kMargin = 1e-5;

struct Counts {
  int proven = 0;
  int refuted = 0;
  int missed = 0;  ///< proofs, of radii that are clearly small enough
  int touching = 0;
};

/// The answers about one segment. `far`: m, of the set from the origin.
template <typename Set>
void judge(const Set& set, const LineSegment& segment, double truth, double atCenter, double far,
           Counts& counts) {
  if (truth == 0.0) ++counts.touching;
  for (const double radius : {0.0, 0.5 * truth, truth - kMargin, truth - 1e-9, truth, truth + 1e-9,
                              truth + kMargin, 2.0 * truth}) {
    if (!(radius >= 0.0)) continue;
    const bool farther = isFarther(set, segment, radius);
    // The oracle's own rounding.
    if (farther) {
      ASSERT_GT(truth + 1e-14, radius);
    }
    farther ? ++counts.proven : ++counts.refuted;
    if (radius <= truth - kMargin) counts.missed += !farther;
  }
  for (const double radius : {0.5 * atCenter, atCenter - kMargin, atCenter + kMargin, 1.0}) {
    if (!(radius >= 0.0)) continue;
    const auto found = pointWithin(set, segment.center, radius);
    ASSERT_EQ(found.has_value(), radius >= atCenter) << radius << " " << atCenter;
    if (!found) continue;
    ASSERT_LE((*found - segment.center).norm(), radius + 1e-14);
    // It is one of the set.
    ASSERT_LE(bruteForce(set, {*found}), 1e-14 * (1.0 + far));
  }
}

/// On every instruction set.
template <typename Set>
void check(const Set& set, const Vector3d& offset, std::mt19937& random, Counts& counts) {
  for (int i = 0; i < 150; ++i) {
    LineSegment segment{offset + test::uniformPoint(random, 1.5)};
    if (i % 3 != 0) {
      const double length = std::pow(10.0, -uniform(random, 0.0, 4.0));
      segment.half = length * test::unitVector(random);
    }
    if constexpr (std::is_same_v<Set, PointCloud>) {
      if (i % 5 == 0)
        segment.center = set.points()[random() % set.points().size()] + 1.3 * segment.half;
    }
    const double truth = bruteForce(set, segment);
    const double atCenter = bruteForce(set, {segment.center});
    for (const std::int64_t target : simd_test::simdTargets()) {
      const simd_test::OnTarget on(target);
      judge(set, segment, truth, atCenter, offset.norm(), counts);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

/// On every instruction set that is compiled and that this machine has.
class Clearance : public testing::TestWithParam<std::int64_t> {
 private:
  simd_test::OnTarget on_{GetParam()};
};
class SegmentQueryOnTarget : public Clearance {};

double signedBruteForce(const PointCloud& cloud, const Vector3d& p) {
  double nearest = kInfinity;
  for (std::size_t i = 0; i < cloud.points().size(); ++i)
    nearest = std::min(nearest, (p - cloud.points()[i]).norm() - cloud.radius(i));
  return nearest;
}

TEST_P(Clearance, IsThatOfTheNearestBall) {
  std::mt19937 random(24);
  int inside = 0, outside = 0;
  for (const double offset : {0.0, 1e3, 1e6}) {
    for (int i = 0; i < 10; ++i) {
      const Vector3d origin = offset * test::unitVector(random);
      const PointCloud cloud = points(random, origin, i % 2 == 0 ? 0.0 : 0.6);
      for (int j = 0; j < 200; ++j) {
        const Vector3d p = origin + test::uniformPoint(random, j % 4 == 0 ? 20.0 : 1.2);
        const double truth = signedBruteForce(cloud, p);
        const double rounding = 1e-14 * (2.0 * offset + 50.0);
        const double found = clearance(cloud, p);
        ASSERT_LE(found, truth + 1e-15);
        ASSERT_GE(found, truth - rounding);
        const double enough = 0.3;
        const double some = clearance(cloud, p, enough);
        if (truth >= enough + rounding) {
          ASSERT_EQ(some, enough);
        } else if (truth < enough - rounding) {
          ASSERT_EQ(some, found);
        }
        ++(truth < 0.0 ? inside : outside);
      }
    }
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 3000);
}

TEST_P(Clearance, OfManyPointsIsThatOfTheNearestBall) {
  std::mt19937 random(25);
  std::vector<Vector3d> many;
  for (int i = 0; i < 5000; ++i) many.push_back(test::unitVector(random));
  const PointCloud cloud = PointCloud::build(many, 0.01);
  for (int i = 0; i < 500; ++i) {
    const Vector3d p = test::uniformPoint(random, 1.5);
    EXPECT_NEAR(clearance(cloud, p), signedBruteForce(cloud, p), 1e-13);
  }
}

TEST_P(Clearance, OfWhatIsNotFiniteIsNone) {
  const PointCloud cloud = PointCloud::build(std::vector<Vector3d>{Vector3d::Zero()}, 0.1);
  EXPECT_EQ(clearance(cloud, {NAN, 0.0, 0.0}), -kInfinity);
  EXPECT_EQ(clearance(cloud, {0.0, kInfinity, 0.0}), -kInfinity);
  EXPECT_EQ(clearance(cloud, {1.0, 0.0, 0.0}, NAN), -kInfinity);
  EXPECT_NEAR(clearance(cloud, {1e200, 0.0, 0.0}), 1e200, 1e187);
}

/// Where the squares of distances are no floats, and where those of coordinates are no doubles.
TEST_P(Clearance, OfFarPointsIsNotInfinite) {
  std::mt19937 random(26);
  std::vector<Vector3d> many;
  for (int i = 0; i < 1000; ++i) many.push_back(test::unitVector(random));
  const PointCloud cloud = PointCloud::build(many, 0.01);
  for (const double far : {1e15, 1e19, 1e20, 1e30, 1e100, 1e200}) {
    const double found = clearance(cloud, {far, 0.0, 0.0});
    EXPECT_LE(found, far);
    EXPECT_GE(found, 0.999 * far);
  }
}

TEST(SegmentQuery, ProvesWhatIsTrueAboutTriangles) {
  std::mt19937 random(21);
  Counts counts;
  for (int i = 0; i < 12; ++i) {
    const Vector3d offset = Vector3d::Constant(i % 3 == 0 ? 10.0 : 0.0);
    check(triangles(random, offset), offset, random, counts);
  }
  const auto targets = static_cast<int>(simd_test::simdTargets().size());
  EXPECT_GT(counts.proven, 3000 * targets);
  EXPECT_GT(counts.refuted, 3000 * targets);
  EXPECT_EQ(counts.missed, 0);
}

TEST(SegmentQuery, ProvesWhatIsTrueAboutPoints) {
  std::mt19937 random(22);
  Counts counts;
  for (int i = 0; i < 12; ++i) {
    const Vector3d offset = Vector3d::Constant(i % 3 == 0 ? 10.0 : 0.0);
    check(points(random, offset, i % 2 == 0 ? 0.05 : 0.0), offset, random, counts);
  }
  const auto targets = static_cast<int>(simd_test::simdTargets().size());
  EXPECT_GT(counts.proven, 3000 * targets);
  EXPECT_GT(counts.refuted, 3000 * targets);
  EXPECT_GT(counts.touching, 50 * targets);
  EXPECT_EQ(counts.missed, 0);
}

/// Segments that pass through triangles, and what a mesh encloses.
TEST_P(SegmentQueryOnTarget, CountsSurfacesOnly) {
  std::mt19937 random(23);
  const test::Soup soup = test::boxSoup(Vector3d::Constant(-1.0), Vector3d::Constant(1.0));
  const TriangleMesh mesh = TriangleMesh::build(soup.vertices, soup.triangles);
  EXPECT_TRUE(isFarther(mesh, {Vector3d::Zero()}, 0.999));
  EXPECT_FALSE(isFarther(mesh, {Vector3d::Zero()}, 1.001));
  for (int i = 0; i < 1000; ++i) {
    const Vector3d inside = test::uniformPoint(random, 0.99);
    const Vector3d half = 4.0 * test::unitVector(random);
    EXPECT_FALSE(isFarther(mesh, {inside, half}, 0.0));
    EXPECT_FALSE(isFarther(mesh, {inside + half, half}, 0.0));
    EXPECT_TRUE(isFarther(mesh, {inside + 2.0 * half, 0.4 * half}, 0.0));
  }
}

TEST_P(SegmentQueryOnTarget, NoNumberProvesNothing) {
  std::mt19937 random(24);
  const TriangleMesh mesh = triangles(random, Vector3d::Zero());
  const PointCloud cloud = points(random, Vector3d::Zero(), 0.1);
  for (const double bad : {std::nan(""), kInfinity, -kInfinity}) {
    for (int i = 0; i < 7; ++i) {
      LineSegment segment{Vector3d::Constant(9.0), Vector3d::Constant(0.1)};
      double radius = 0.1;
      if (i == 6) {
        radius = bad;
      } else {
        (i < 3 ? segment.center : segment.half)[i % 3] = bad;
      }
      EXPECT_FALSE(isFarther(mesh, segment, radius));
      EXPECT_FALSE(isFarther(cloud, segment, radius));
      if (i >= 3 && i < 6) continue;
      EXPECT_FALSE(pointWithin(mesh, segment.center, radius));
      EXPECT_FALSE(pointWithin(cloud, segment.center, radius));
    }
  }
}

std::string nameOf(const testing::TestParamInfo<std::int64_t>& target) {
  return hwy::TargetName(target.param);
}
INSTANTIATE_TEST_SUITE_P(Targets, Clearance, testing::ValuesIn(simd_test::simdTargets()), nameOf);
INSTANTIATE_TEST_SUITE_P(Targets, SegmentQueryOnTarget, testing::ValuesIn(simd_test::simdTargets()),
                         nameOf);

}  // namespace
}  // namespace swept
