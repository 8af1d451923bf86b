// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/convex_hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <set>

#include "geometry/orientation.hpp"
#include "geometry/quickhull.hpp"
#include "mesh_samples.hpp"
#include "message_of.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using Points = std::vector<Vector3d>;

double largestAlong(const Points& points, const Vector3d& direction) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const Vector3d& p : points) largest = std::max(largest, direction.dot(p));
  return largest;
}

double magnitude(const Points& points) {
  double largest = 0.0;
  for (const Vector3d& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

/// The surface, if any, is closed and convex with all vertices on it.
void checkFaces(const ConvexHull& hull) {
  std::map<std::pair<int, int>, int> edges;
  std::set<int> corners;
  for (const Vector3i& face : hull.faces()) {
    for (int i = 0; i < 3; ++i) {
      ++edges[{face[i], face[(i + 1) % 3]}];
      corners.insert(face[i]);
    }
    const Vector3d a = hull.vertices()[face[0]];
    const Vector3d across = (hull.vertices()[face[1]] - a).cross(hull.vertices()[face[2]] - a);
    double ahead = 0.0;
    double size = 0.0;
    for (const Vector3d& v : hull.vertices()) {
      ahead = std::max(ahead, across.normalized().dot(v - a));
      size = std::max(size, (v - a).norm());
    }
    // The normal is rounded by as much as the face is slender.
    EXPECT_LE(ahead, 1e-14 * size * (1.0 + size * size / across.norm()));
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  if (!hull.faces().empty()) {
    EXPECT_EQ(hull.faces().size(), 2 * corners.size() - 4);  // Euler
  }
}

/// Checks every promise of the header and returns the hull. `mostError` is relative to the
/// coordinates.
ConvexHull checkedHull(const Points& points, double mostError = 2e-12) {
  std::mt19937 random(31);
  ConvexHull hull = ConvexHull::of(points);
  const double scale = magnitude(points);
  EXPECT_GE(hull.error(), 0.0);
  EXPECT_LE(hull.error(), mostError * scale);
  for (const Vector3d& v : hull.vertices()) {
    EXPECT_NE(std::find(points.begin(), points.end(), v), points.end());
    EXPECT_LE(v.norm(), hull.extent());
  }
  // A point outside the grown hull is ahead of it along some direction: random ones, and the
  // normals of the faces, which are the ones that matter for a polytope.
  Points directions;
  for (int i = 0; i < 200; ++i) directions.push_back(test::unitVector(random));
  for (int i = 0; i < 3; ++i)
    directions.insert(directions.end(), {Vector3d::Unit(i), -Vector3d::Unit(i)});
  for (std::size_t i = 0; i < std::min<std::size_t>(hull.faces().size(), 300); ++i) {
    const Vector3i& face = hull.faces()[i];
    const Vector3d a = hull.vertices()[face[0]];
    directions.push_back(
        (hull.vertices()[face[1]] - a).cross(hull.vertices()[face[2]] - a).stableNormalized());
  }
  const double rounding = 1e-15 * scale;
  for (const Vector3d& direction : directions) {
    EXPECT_LE(largestAlong(points, direction),
              largestAlong(hull.vertices(), direction) + hull.error() + rounding);
  }
  checkFaces(hull);
  return hull;
}

Points rotated(const Points& points) {
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  Points out;
  for (const Vector3d& p : points) out.push_back(rotation * p + Vector3d(0.1, -0.2, 0.3));
  return out;
}

TEST(ConvexHull, BoundsRandomPoints) {
  std::mt19937 random(32);
  const std::vector<std::function<Vector3d()>> clouds = {
      [&] { return test::uniformPoint(random, 1.0); },
      [&]() -> Vector3d {
        const double reach = std::cbrt(test::uniform(random, 0, 1));
        return reach * test::unitVector(random);
      },
      [&]() -> Vector3d {
        return test::unitVector(random).cwiseProduct(Vector3d(1.0, 0.1, 0.01)) +
               Vector3d::Constant(5.0);
      },
  };
  for (const auto& draw : clouds) {
    for (int count : {4, 5, 8, 50, 2000}) {
      Points points;
      for (int i = 0; i < count; ++i) points.push_back(draw());
      const ConvexHull hull = checkedHull(points);
      EXPECT_FALSE(hull.faces().empty());
    }
  }
}

/// A coarser hull grown by its error contains every vertex: no direction shows one ahead of it.
TEST(ConvexHull, CoarserHullsContainTheVertices) {
  std::mt19937 random(34);
  for (const double flat : {1.0, 0.1, 1e-3}) {
    Points points;
    for (int i = 0; i < 3000; ++i) {
      points.push_back(test::unitVector(random).cwiseProduct(Vector3d(1.0, 0.5, flat)) +
                       Vector3d::Constant(3.0));
    }
    const ConvexHull hull = ConvexHull::of(points);
    const ConvexHull coarse = ConvexHull::coarser(hull);
    ASSERT_GT(hull.vertices().size(), ConvexHull::kFew);
    EXPECT_LE(coarse.vertices().size(), static_cast<std::size_t>(ConvexHull::kCoarse));
    EXPECT_LT(coarse.error(), 0.05);
    checkFaces(coarse);
    Points directions;
    for (int i = 0; i < 3000; ++i) directions.push_back(test::unitVector(random));
    for (const Vector3i& face : coarse.faces()) {
      const Vector3d a = coarse.vertices()[face[0]];
      directions.push_back((coarse.vertices()[face[1]] - a)
                               .cross(coarse.vertices()[face[2]] - a)
                               .stableNormalized());
    }
    double mostAhead = 0.0;
    for (const Vector3d& d : directions) {
      const double ahead =
          largestAlong(hull.vertices(), d) - largestAlong(coarse.vertices(), d) - coarse.error();
      EXPECT_LE(ahead, 1e-15);
      mostAhead = std::max(mostAhead, ahead + coarse.error());
    }
    EXPECT_GT(mostAhead, 0.5 * coarse.error()) << "an error far larger than needed";
  }
}

TEST(ConvexHull, FewVerticesNeedNoCoarserHull) {
  std::mt19937 random(35);
  Points points;
  for (int i = 0; i < 300; ++i) points.push_back(test::unitVector(random));
  const ConvexHull hull = ConvexHull::of(points);
  EXPECT_EQ(ConvexHull::coarser(hull).vertices().size(), hull.vertices().size());
  EXPECT_EQ(ConvexHull::coarser(hull).error(), hull.error());
}

TEST(ConvexHull, KeepsOnlyExtremePoints) {
  std::mt19937 random(33);
  // A cloud inside a cube whose corners are given: these are all that is kept, exactly.
  Points points = test::boxSoup(-Vector3d::Ones(), Vector3d::Ones()).vertices;
  for (int i = 0; i < 5000; ++i) points.push_back(test::uniformPoint(random, 1.0));
  std::shuffle(points.begin(), points.end(), random);
  const ConvexHull hull = checkedHull(points);
  EXPECT_EQ(hull.vertices().size(), 8u);
  EXPECT_EQ(hull.faces().size(), 12u);
  for (const Vector3d& v : hull.vertices()) EXPECT_EQ(v.cwiseAbs(), Vector3d::Ones());

  Points sphere;
  for (int i = 0; i < 3000; ++i) sphere.push_back(test::unitVector(random));
  EXPECT_EQ(checkedHull(sphere).vertices().size(), 3000u);
  EXPECT_EQ(checkedHull(sphere).error(), 0.0);
}

TEST(ConvexHull, CopesWithManyCoplanarPoints) {
  Points grid;
  for (int axis = 0; axis < 3; ++axis) {
    for (double side : {-0.5, 0.5}) {
      for (int i = 0; i <= 24; ++i) {
        for (int j = 0; j <= 24; ++j) {
          Vector3d p;
          p[axis] = side;
          p[(axis + 1) % 3] = i / 24.0 - 0.5;
          p[(axis + 2) % 3] = j / 24.0 - 0.5;
          grid.push_back(p);
        }
      }
    }
  }
  EXPECT_LE(checkedHull(grid).vertices().size(), 100u);
  // Rotated, the faces are flat up to rounding only.
  EXPECT_LE(checkedHull(rotated(grid)).vertices().size(), 100u);

  Points cylinder;
  for (int i = 0; i < 400; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 400;
    for (double z : {-1.0, 0.0, 1.0}) {
      for (double r : {0.0, 0.5, 1.0}) cylinder.emplace_back(r * std::cos(a), r * std::sin(a), z);
    }
  }
  for (const Points& points : {cylinder, rotated(cylinder)}) {
    const ConvexHull hull = checkedHull(points);
    EXPECT_GE(hull.vertices().size(), 800u);
    EXPECT_LE(hull.vertices().size(), 1200u);
  }
}

TEST(ConvexHull, HandlesSetsWithoutVolume) {
  const ConvexHull point = checkedHull({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
  EXPECT_EQ(point.vertices().size(), 1u);
  EXPECT_TRUE(point.faces().empty());
  EXPECT_EQ(point.error(), 0.0);
  EXPECT_EQ(checkedHull({{0.0, 0, 0}, {-0.0, 0, -0.0}}).vertices().size(), 1u);
  EXPECT_EQ(checkedHull({{1, 2, 3}, {3, 2, 1}}).vertices().size(), 2u);
  EXPECT_EQ(checkedHull({{1, 2, 3}, {3, 2, 1}, {0, 0, 0}}).vertices().size(), 3u);

  Points line;
  Points plane;
  for (int i = 0; i < 50; ++i) {
    line.emplace_back(0.1 * i, 0.2 * i, -0.3 * i);
    for (int j = 0; j < 50; ++j) plane.emplace_back(0.1 * i, 0.0, 0.1 * j);
  }
  EXPECT_EQ(checkedHull(line).vertices().size(), 2u);
  EXPECT_EQ(checkedHull(plane).vertices().size(), 4u);
  EXPECT_TRUE(checkedHull(plane).faces().empty());
  EXPECT_LE(checkedHull(rotated(line)).vertices().size(), 4u);
  EXPECT_LE(checkedHull(rotated(plane)).vertices().size(), 100u);
}

TEST(ConvexHull, HandlesNearlyFlatSets) {
  std::mt19937 random(34);
  // Decisions turn from spatial to planar to linear in this range. Needles between two of them are
  // too thin for the planes of their sides to be computed, and keep every point.
  for (int exponent = -18; exponent <= -2; ++exponent) {
    const double thin = std::pow(10.0, exponent);
    Points plate;
    Points needle;
    for (int i = 0; i < 300; ++i) {
      const Vector3d p = test::uniformPoint(random, 1.0);
      plate.emplace_back(p.x(), p.y(), thin * p.z());
      needle.emplace_back(p.x(), thin * p.y(), thin * p.z());
    }
    SCOPED_TRACE(exponent);
    EXPECT_LT(checkedHull(plate).vertices().size(), 200u);
    EXPECT_LT(checkedHull(rotated(plate)).vertices().size(), 200u);
    const bool decided = exponent <= -13 || exponent >= -6;
    for (const Points& points : {needle, rotated(needle)}) {
      EXPECT_LT(checkedHull(points).vertices().size(), decided ? 200u : 301u);
    }
  }
}

TEST(ConvexHull, WorksAtAllScales) {
  std::mt19937 random(35);
  for (double scale : {1e-300, 1e-150, 1e-6, 1e6, 1e150, 1e307}) {
    Points points;
    for (int i = 0; i < 200; ++i) points.push_back(scale * test::uniformPoint(random, 1.0));
    const ConvexHull hull = ConvexHull::of(points);
    EXPECT_LT(hull.vertices().size(), 150u) << scale;
    EXPECT_FALSE(hull.faces().empty()) << scale;
    EXPECT_LE(hull.error(), 2e-12 * scale);
    for (int i = 0; i < 100; ++i) {
      const Vector3d direction = test::unitVector(random);
      EXPECT_LE(largestAlong(points, direction),
                largestAlong(hull.vertices(), direction) + hull.error() + 1e-15 * scale);
    }
    for (const Vector3d& v : hull.vertices()) EXPECT_LE(v.stableNorm(), hull.extent());
  }
  // Small and far from the origin: few bits are left, and the hull is that of the rounded points.
  Points far;
  for (int i = 0; i < 500; ++i) {
    far.push_back(1e-3 * test::uniformPoint(random, 1.0) + Vector3d::Constant(1e6));
  }
  checkedHull(far);
}

/// How often a ray is compared with something, on average, until its face is known. In fans of n
/// faces, as around the poles of cones and in the lids of cylinders, a walk from face to face took
/// about n / 2 steps: 64000 points took ten seconds, and four times as many sixteen times as long.
double meanLooks(const Points& points, const std::array<int, 4>& start) {
  const detail::Quickhull hull(points, start);
  EXPECT_TRUE(hull.consistent());
  Vector3d inside = Vector3d::Zero();
  for (int corner : start) inside += 0.25 * points[corner];
  double looks = 0.0;
  int astray = 0;
  for (const Vector3d& p : points) {
    const detail::HullExit found = hull.exitOf(inside, p - inside);
    const detail::Cone cone{points[found.corners[0]] - inside, points[found.corners[1]] - inside,
                            points[found.corners[2]] - inside};
    astray += cone.distanceBound(p - inside, detail::Cone::Part::Tetrahedron) > 1e-9 ? 1 : 0;
    looks += found.looks;
  }
  EXPECT_LE(astray, static_cast<int>(points.size()) / 1000);
  return looks / static_cast<double>(points.size());
}

TEST(ConvexHull, FindsTheFaceOfAPointInAFewLooks) {
  std::mt19937 random(37);
  const Eigen::Matrix3d turned =
      Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  enum class Rim : std::uint8_t { Cone, Cylinder, Disc, Sphere };
  for (const Rim rim : {Rim::Cone, Rim::Cylinder, Rim::Disc, Rim::Sphere}) {
    std::array<double, 2> looks{};
    for (std::size_t size = 0; size < looks.size(); ++size) {
      const int count = size == 0 ? 500 : 32000;
      Points points{{0.0, 0.0, 0.9}, {0.6, 0.0, -0.6}, {-0.6, 0.0, -0.6}, {0.0, 0.6, -0.6}};
      for (int i = 1; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count;
        const Vector3d around(0.6 * std::cos(angle), 0.6 * std::sin(angle), -0.6);
        const Vector3d upper(around.x(), around.y(), 0.6);
        points.push_back(rim == Rim::Sphere ? Vector3d(0.9 * test::unitVector(random)) : around);
        if (rim == Rim::Cylinder) points.push_back(upper);
        if (rim == Rim::Disc) points.push_back(0.3 * test::uniformPoint(random, 1.0));
        const double up = test::uniform(random, 0.0, 1.0);
        if (rim == Rim::Cone) points.push_back(0.999 * ((1.0 - up) * around + up * points[0]));
      }
      for (Vector3d& p : points) p = turned * p;
      looks[size] = meanLooks(points, {0, 1, 2, 3});
    }
    SCOPED_TRACE(testing::Message() << static_cast<int>(rim) << ' ' << looks[0]);
    // Their number grows with the square of the logarithm at most.
    EXPECT_LE(looks[1], 3.0 * looks[0]);
    EXPECT_LE(looks[1], 150.0);
  }
}

TEST(ExactOrientation, SeesOneUlp) {
  // Points of the plane z = x + y whose coordinates need all 53 bits, so that rounded determinants
  // are noise.
  std::mt19937_64 random(36);
  const auto draw = [&] {
    const double x = std::ldexp(static_cast<double>(random() >> 13), -52);
    const double y = std::ldexp(static_cast<double>(random() >> 13), -52);
    return Vector3d(x, y, x + y);
  };
  const Vector3d up(-1.0, -1.0, 1.0);
  int noisy = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d a = draw();
    const Vector3d b = draw();
    const Vector3d c = draw();
    const Vector3d p = draw();
    const int facing = (b - a).cross(c - a).dot(up) > 0.0 ? 1 : -1;
    ASSERT_EQ(detail::exactOrientation(a, b, c, p), 0);
    Vector3d above = p;
    above.z() = std::nextafter(p.z(), 2.0);
    Vector3d below = p;
    below.z() = std::nextafter(p.z(), -2.0);
    ASSERT_EQ(detail::exactOrientation(a, b, c, above), facing);
    ASSERT_EQ(detail::exactOrientation(a, b, c, below), -facing);

    const detail::OrientedPlane plane(a, b, c);
    ASSERT_LE(std::abs(plane.height(above)), plane.bound());
    noisy += plane.height(p) != 0.0 ? 1 : 0;
  }
  EXPECT_GT(noisy, 500);
}

std::string messageOf(const Points& points) {
  return test::messageOf([&] { ConvexHull::of(points); });
}

TEST(ConvexHullErrors, NameTheValue) {
  EXPECT_EQ(messageOf({}), "convex hull has no points; allowed: at least 1");
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(messageOf({{0, 0, 0}, {0, -infinity, 1}}),
            "convex hull point 1 is (0, -inf, 1); allowed: finite coordinates");
}

}  // namespace
}  // namespace swept
