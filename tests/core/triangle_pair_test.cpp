// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/triangle_pair.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "triangle_oracle.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double within(double reach) {
    return std::uniform_real_distribution<double>(-reach, reach)(engine_);
  }
  int integer(int reach) { return std::uniform_int_distribution<int>(-reach, reach)(engine_); }
  Vector3d point(double reach) { return {within(reach), within(reach), within(reach)}; }
  Vector3d lattice(int reach) { return Vector3d(integer(reach), integer(reach), integer(reach)); }
  TriangleCorners triangle(double reach) { return {point(reach), point(reach), point(reach)}; }
  /// Integer weights of sum 8, none negative.
  std::array<double, 3> eighths() {
    const int first = std::abs(integer(4));
    const int second = std::abs(integer(4));
    return {first / 8.0, second / 8.0, (8 - first - second) / 8.0};
  }

 private:
  std::mt19937 engine_;
};

TriangleCorners moved(TriangleCorners t, double scale, const Vector3d& offset) {
  for (Vector3d& corner : t) corner = scale * corner + offset;
  return t;
}

double largestDifference(const TriangleCorners& a, const TriangleCorners& b) {
  double most = 0.0;
  for (const Vector3d& x : {a[0], a[1], a[2], b[0], b[1], b[2]}) {
    for (const Vector3d& y : {a[0], b[0]}) most = std::max(most, (x - y).cwiseAbs().maxCoeff());
  }
  return most;
}

double largestCoordinate(const TriangleCorners& a, const TriangleCorners& b) {
  double most = 0.0;
  for (int i = 0; i < 3; ++i) {
    most = std::max({most, a[i].cwiseAbs().maxCoeff(), b[i].cwiseAbs().maxCoeff()});
  }
  return most;
}

struct Case {
  TriangleCorners a;
  TriangleCorners b;
};

/// A sample of pairs, by name: what the error table has a row for.
struct Family {
  std::string name;
  Case (*sample)(Random&, int);
};

Case generic(Random& random, int) {
  return {random.triangle(1.0), moved(random.triangle(1.0), 1.0, random.point(0.25))};
}

/// Sizes apart by up to 1e6, scales 1e-6 to 1e6, offsets up to 1000 sizes.
Case scaled(Random& random, int trial) {
  const double scale = std::pow(10.0, random.within(6.0));
  const double ratio = std::pow(10.0, -std::abs(random.within(6.0)));
  const TriangleCorners a = random.triangle(1.0);
  // Half of them through a point of the first triangle, so that sizes far apart still meet.
  const Vector3d on = (a[0] + 2.0 * a[1] + a[2]) / 4.0;
  const double apart = trial % 2 == 0 ? 0.3 : 1.5;
  const TriangleCorners b = moved(random.triangle(1.0), ratio, on + random.point(apart * ratio));
  const Vector3d offset = random.point(scale * std::pow(10.0, random.within(3.0)));
  return {moved(a, scale, offset), moved(b, scale, offset)};
}

/// Few numbers, hence every degeneracy: equal corners, collinear and coplanar ones, points.
Case lattice(Random& random, int trial) {
  const int reach = 1 + trial % 3;
  Case c;
  for (int i = 0; i < 3; ++i) {
    c.a[i] = random.lattice(reach);
    c.b[i] = random.lattice(reach);
  }
  return c;
}

Case coplanar(Random& random, int trial) {
  Case c = lattice(random, 2);
  for (int i = 0; i < 3; ++i) {
    c.a[i].z() = trial % 2 == 0 ? 0.3 : c.a[i].x() + 2.0 * c.a[i].y();
    c.b[i].z() = trial % 2 == 0 ? 0.3 : c.b[i].x() + 2.0 * c.b[i].y();
  }
  if (trial % 3 == 0) c.b = moved(c.b, 1.0, Vector3d(1.5, -1.0, trial % 2 == 0 ? 0.0 : -0.5));
  return c;
}

/// In one plane but for the rounding of each corner.
Case nearlyCoplanar(Random& random, int trial) {
  Case c{random.triangle(1.0), random.triangle(1.0)};
  const double shift = trial % 3 == 0 ? 1.2 : 0.0;
  for (int i = 0; i < 3; ++i) {
    c.a[i].z() = 0.3 * c.a[i].x() + 0.7 * c.a[i].y();
    c.b[i].x() += shift;
    c.b[i].z() = 0.3 * c.b[i].x() + 0.7 * c.b[i].y();
  }
  return c;
}

/// Touching exactly, in dyadic numbers: shared corner, shared edge, corner in a face, edges that
/// cross. Half of them are then parted by one last place up to 1e-9, or moved into each other.
Case nearContact(Random& random, int trial) {
  const auto dyadic = [&] { return Vector3d(random.lattice(1 << 20) / double(1 << 20)); };
  Case c{{dyadic(), dyadic(), dyadic()}, {dyadic(), dyadic(), dyadic()}};
  const std::array<double, 3> w = random.eighths();
  const Vector3d onFace = w[0] * c.a[0] + w[1] * c.a[1] + w[2] * c.a[2];
  switch (trial % 4) {
    case 0:
      c.b[0] = c.a[1];
      break;
    case 1:
      c.b[0] = c.a[1];
      c.b[2] = c.a[2];
      break;
    case 2:
      c.b[0] = onFace;
      break;
    default:
      // The middle of an edge of b on an edge of a.
      c.b[1] = 2.0 * (0.25 * c.a[0] + 0.75 * c.a[1]) - c.b[0];
  }
  if (trial % 8 < 4) return c;
  const int axis = trial / 8 % 3;
  for (Vector3d& corner : c.b) {
    if (trial % 5 < 2) {
      corner[axis] = std::nextafter(corner[axis], 10.0);
    } else {
      corner[axis] += std::ldexp(1.0, -30 - trial % 20);
    }
  }
  return c;
}

/// Corners within 1e-8 of a line.
Case slivers(Random& random, int trial) {
  const auto sliver = [&](const Vector3d& through) -> TriangleCorners {
    const Vector3d direction = random.point(1.0);
    const double width = std::pow(10.0, -5.0 - 4.0 * std::abs(random.within(1.0)));
    return {Vector3d(through - direction), Vector3d(through + direction * random.within(1.0)),
            Vector3d(through + direction + random.point(width))};
  };
  const Vector3d through = random.point(1.0);
  const double gap = trial % 2 == 0 ? 1e-9 : 1e-3;
  Case c{sliver(through), sliver(through + random.point(gap))};
  if (trial % 3 == 0) c.b = random.triangle(1.0);
  if (trial % 3 == 1) c.b = moved(c.a, 1.0, random.point(trial % 2 == 0 ? 1e-9 : 1e-5));
  return c;
}

/// Faces parallel up to rounding, a box upon a box.
Case parallel(Random& random, int trial) {
  Case c = nearlyCoplanar(random, 1);
  const double gap = std::pow(10.0, -12.0 * (trial % 64) / 64.0);
  if (trial % 4 != 0) c.b = moved(c.b, 1.0, gap * Vector3d(-0.3, -0.7, 1.0));
  return c;
}

const std::vector<Family>& families() {
  static const std::vector<Family> all{{"generic", generic},
                                       {"scales, ratios, offsets", scaled},
                                       {"small integers", lattice},
                                       {"coplanar", coplanar},
                                       {"nearly coplanar", nearlyCoplanar},
                                       {"contact and gaps", nearContact},
                                       {"slivers", slivers},
                                       {"parallel faces", parallel}};
  return all;
}

TEST(TrianglePair, TouchingIsExactInEveryFamily) {
  Random random(11);
  int hits = 0;
  int all = 0;
  std::printf("%-26s touching\n", "triangles");
  for (const Family& family : families()) {
    int familyHits = 0;
    const int trials = 1600;
    for (int trial = 0; trial < trials; ++trial) {
      const Case c = family.sample(random, trial);
      const bool truth = oracle::touch(c.a, c.b);
      ASSERT_EQ(trianglesTouch(c.a, c.b), truth) << family.name << " " << trial;
      familyHits += truth ? 1 : 0;
    }
    std::printf("%-26s %4.1f %%\n", family.name.c_str(), 100.0 * familyHits / trials);
    EXPECT_GT(familyHits, trials / 50) << family.name;
    EXPECT_LT(familyHits, trials * 49 / 50) << family.name;
    hits += familyHits;
    all += trials;
  }
  EXPECT_GT(hits, all * 3 / 10);
  EXPECT_LT(hits, all * 7 / 10);
}

TEST(TrianglePair, TouchingIsSymmetricAndIndependentOfTheOrderOfCorners) {
  Random random(12);
  for (const Family& family : families()) {
    for (int trial = 0; trial < 300; ++trial) {
      const Case c = family.sample(random, trial);
      const bool touching = trianglesTouch(c.a, c.b);
      std::array<int, 3> order{0, 1, 2};
      do {
        const TriangleCorners a{c.a[order[0]], c.a[order[1]], c.a[order[2]]};
        const TriangleCorners b{c.b[order[1]], c.b[order[0]], c.b[order[2]]};
        ASSERT_EQ(trianglesTouch(a, c.b), touching) << family.name;
        ASSERT_EQ(trianglesTouch(b, a), touching) << family.name;
      } while (std::next_permutation(order.begin(), order.end()));
    }
  }
}

/// Largest errors over the largest coordinate difference of each pair.
struct ErrorRow {
  double lowerBeyond = 0.0;
  double upperOff = 0.0;
  double width = 0.0;
  double pointsOff = 0.0;  ///< over the largest coordinate
  int touching = 0;
};

double distanceToTriangle(const Vector3d& p, const TriangleCorners& t) {
  return static_cast<double>(oracle::distance({p, p, p}, t));
}

void judge(const Case& c, ErrorRow& row) {
  const TriangleDistance found = triangleDistance(c.a, c.b);
  const double size = largestDifference(c.a, c.b);
  const double reach = largestCoordinate(c.a, c.b);
  ASSERT_TRUE(found.pointA.allFinite() && found.pointB.allFinite());
  ASSERT_GE(found.lower, 0.0);
  ASSERT_LE(found.lower, found.upper);
  const double off =
      std::max(distanceToTriangle(found.pointA, c.a), distanceToTriangle(found.pointB, c.b));
  const double spread = std::abs((found.pointB - found.pointA).norm() - found.upper);
  row.pointsOff = std::max(row.pointsOff, std::max(off, spread) / reach);
  if (oracle::touch(c.a, c.b)) {
    ASSERT_EQ(found.upper, 0.0);
    ++row.touching;
    return;
  }
  ASSERT_GT(found.upper, 0.0);
  const oracle::Real truth = oracle::distance(c.a, c.b);
  row.lowerBeyond =
      std::max(row.lowerBeyond, static_cast<double>(oracle::Real(found.lower) - truth) / size);
  row.upperOff = std::max(row.upperOff,
                          std::abs(static_cast<double>(oracle::Real(found.upper) - truth)) / size);
  row.width = std::max(row.width, (found.upper - found.lower) / size);
}

TEST(TrianglePair, DistanceErrorsAgainstFiftyDigits) {
  Random random(13);
  std::printf("%-26s %9s %12s %12s %12s %12s\n", "triangles", "touching", "lower beyond",
              "upper off", "width", "points off");
  for (const Family& family : families()) {
    ErrorRow row;
    for (int trial = 0; trial < 1000; ++trial) {
      judge(family.sample(random, trial), row);
      ASSERT_FALSE(HasFatalFailure()) << family.name << " " << trial;
    }
    std::printf("%-26s %9d %12.1e %12.1e %12.1e %12.1e\n", family.name.c_str(), row.touching,
                row.lowerBeyond, row.upperOff, row.width, row.pointsOff);
    EXPECT_LE(row.lowerBeyond, 0.0) << family.name;  // proven is proven
    EXPECT_LE(row.upperOff, 4e-15) << family.name;
    EXPECT_LE(row.width, 1e-13) << family.name;
    EXPECT_LE(row.pointsOff, 4e-15) << family.name;
    EXPECT_LT(row.touching, 1000) << family.name;
  }
}

TEST(TrianglePair, DistanceIsSymmetricAndIndependentOfTheOrderOfCorners) {
  Random random(14);
  for (const Family& family : families()) {
    for (int trial = 0; trial < 300; ++trial) {
      const Case c = family.sample(random, trial);
      const double size = largestDifference(c.a, c.b);
      const double distance = triangleDistance(c.a, c.b).upper;
      EXPECT_NEAR(triangleDistance(c.b, c.a).upper, distance, 1e-14 * size) << family.name;
      EXPECT_NEAR(triangleDistance({c.a[2], c.a[0], c.a[1]}, c.b).upper, distance, 1e-14 * size);
      EXPECT_NEAR(triangleDistance(c.a, {c.b[1], c.b[0], c.b[2]}).upper, distance, 1e-14 * size);
    }
  }
}

TEST(TrianglePair, DistanceChangesNoMoreThanATranslation) {
  Random random(15);
  for (const Family& family : families()) {
    for (int trial = 0; trial < 300; ++trial) {
      const Case c = family.sample(random, trial);
      const double size = largestDifference(c.a, c.b);
      const Vector3d motion = random.point(size * std::pow(10.0, -std::abs(random.within(9.0))));
      const double change =
          triangleDistance(c.a, moved(c.b, 1.0, motion)).upper - triangleDistance(c.a, c.b).upper;
      // The moved corners are rounded too.
      EXPECT_LE(std::abs(change), motion.norm() + 4e-15 * (size + largestCoordinate(c.a, c.b)))
          << family.name;
    }
  }
}

TEST(TrianglePair, StopsOnlyOnceTheDistanceIsProvenToBeEnough) {
  Random random(16);
  int stopped = 0;
  int full = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const Case c = generic(random, trial);
    const double enough = std::abs(random.within(0.6));
    const TriangleDistance exact = triangleDistance(c.a, c.b);
    const TriangleDistance found = triangleDistance(c.a, c.b, enough);
    ASSERT_LE(found.lower, exact.upper);
    if (std::isinf(found.upper)) {
      ASSERT_GT(found.lower, enough);
      ++stopped;
    } else {
      ASSERT_NEAR(found.upper, exact.upper, 1e-14);
      ASSERT_LE(found.upper - found.lower, 1e-13);
      ++full;
    }
  }
  EXPECT_GT(stopped, 400);
  EXPECT_GT(full, 400);
}

TEST(TrianglePair, ExtremeAndNonFiniteCoordinatesErrTowardsTouching) {
  Random random(17);
  for (const double scale : {1e-300, 1e-150, 1e-80, 1e80, 1e150, 1e300}) {
    for (int trial = 0; trial < 500; ++trial) {
      const Case unit = generic(random, trial);
      const Case c{moved(unit.a, scale, Vector3d::Zero()), moved(unit.b, scale, Vector3d::Zero())};
      const bool touching = trianglesTouch(unit.a, unit.b);
      if (scale > 1e-90 && scale < 1e90) {
        ASSERT_EQ(trianglesTouch(c.a, c.b), touching);
      } else if (touching) {
        ASSERT_TRUE(trianglesTouch(c.a, c.b));
      }
      const TriangleDistance truth = triangleDistance(unit.a, unit.b);
      const TriangleDistance found = triangleDistance(c.a, c.b);
      ASSERT_LE(found.lower / scale, truth.upper * (1.0 + 1e-12));
      ASSERT_TRUE(found.pointA.allFinite() && found.pointB.allFinite());
      if (scale < 1e90) {
        ASSERT_NEAR(found.lower / scale, truth.lower, 1e-12);
      }
    }
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity}) {
    for (int k = 0; k < 18; ++k) {
      Case c{{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()},
             {Vector3d(5, 5, 5), Vector3d(6, 5, 5), Vector3d(5, 6, 7)}};
      (k < 9 ? c.a : c.b)[k % 9 / 3][k % 3] = bad;
      EXPECT_TRUE(trianglesTouch(c.a, c.b)) << bad << " " << k;
      EXPECT_EQ(triangleDistance(c.a, c.b).lower, 0.0) << bad << " " << k;
      EXPECT_EQ(triangleDistance(c.a, c.b, 0.1).lower, 0.0) << bad << " " << k;
    }
  }
}

TEST(TriangleContact, PiercingCornerGoesOutTheWayItCameIn) {
  const TriangleCorners floor{Vector3d(-4, -4, 0), Vector3d(4, -4, 0), Vector3d(0, 5, 0)};
  const TriangleCorners wall{Vector3d(0, 0, -0.25), Vector3d(0.5, 0.1, 2), Vector3d(-0.5, 0.1, 2)};
  const TriangleContact contact = triangleContact(floor, wall);
  EXPECT_NEAR(contact.depth, 0.25, 1e-15);
  EXPECT_LE((contact.normal - Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LE((contact.pointB - Vector3d(0, 0, -0.25)).norm(), 1e-15);
  EXPECT_LE((contact.pointA - Vector3d::Zero()).norm(), 1e-15);
  const TriangleContact swapped = triangleContact(wall, floor);
  EXPECT_NEAR(swapped.depth, 0.25, 1e-15);
  EXPECT_LE((swapped.normal + Vector3d::UnitZ()).norm(), 1e-15);
}

/// Least translation along +-n that parts the triangles, by bisection on the exact predicate alone.
double partingTranslation(const TriangleCorners& a, const TriangleCorners& b, const Vector3d& n) {
  double touching = 0.0;
  double apart = 8.0;  // more than both triangles' extents
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (touching + apart);
    (trianglesTouch(a, moved(b, 1.0, middle * n)) ? touching : apart) = middle;
  }
  return apart;
}

TEST(TriangleContact, DepthIsTheLeastTranslationAlongAFaceNormal) {
  Random random(18);
  int hits = 0;
  double worst = 0.0;
  for (int trial = 0; trial < 8000; ++trial) {
    const Case c = trial % 2 == 0 ? generic(random, trial) : lattice(random, trial);
    if (!trianglesTouch(c.a, c.b)) continue;
    const Vector3d na = (c.a[1] - c.a[0]).cross(c.a[2] - c.a[0]).normalized();
    const Vector3d nb = (c.b[1] - c.b[0]).cross(c.b[2] - c.b[0]).normalized();
    if (!(na.norm() > 0.5 && nb.norm() > 0.5)) continue;
    double least = 8.0;
    for (const Vector3d& n : {na, nb}) {
      least = std::min({least, partingTranslation(c.a, c.b, n), partingTranslation(c.a, c.b, -n)});
    }
    const TriangleContact contact = triangleContact(c.a, c.b);
    worst = std::max(worst, std::abs(contact.depth - least));
    EXPECT_NEAR(contact.normal.norm(), 1.0, 1e-14);
    EXPECT_LE((contact.pointA - contact.depth * contact.normal - contact.pointB).norm(), 1e-14);
    // Small integers put edges into the side of the other's prism, and rounding may take them out
    // of it: what is then parted is a triangle that is a rounding away from this one.
    if (trial % 2 == 0) {
      EXPECT_NEAR(partingTranslation(c.a, c.b, contact.normal), least, 1e-11);
    }
    ++hits;
  }
  std::printf("depth of %d crossing triangles: largest error %.1e\n", hits, worst);
  EXPECT_GT(hits, 400);
  EXPECT_LE(worst, 1e-11);
}

TriangleCorners withCoordinates(const TriangleCorners& t, const std::array<int, 3>& order) {
  TriangleCorners result;
  for (int i = 0; i < 3; ++i) result[i] = {t[i][order[0]], t[i][order[1]], t[i][order[2]]};
  return result;
}

/// The largest error of a contact's points, over the largest coordinate.
double contactError(const Case& c) {
  const TriangleContact contact = triangleContact(c.a, c.b);
  EXPECT_TRUE(contact.pointA.allFinite() && contact.pointB.allFinite());
  EXPECT_GE(contact.depth, 0.0);
  EXPECT_FALSE(std::signbit(contact.depth));
  EXPECT_NEAR(contact.normal.norm(), 1.0, 1e-14);
  const double parted = (contact.pointA - contact.depth * contact.normal - contact.pointB).norm();
  return std::max({distanceToTriangle(contact.point, c.a), distanceToTriangle(contact.point, c.b),
                   distanceToTriangle(contact.pointA, c.a), distanceToTriangle(contact.pointB, c.b),
                   parted}) /
         largestCoordinate(c.a, c.b);
}

TEST(TriangleContact, PointsLieOnTheTriangles) {
  Random random(19);
  for (const Family& family : families()) {
    int hits = 0;
    double worst = 0.0;
    for (int trial = 0; trial < 1000; ++trial) {
      const Case c = family.sample(random, trial);
      if (!trianglesTouch(c.a, c.b)) continue;
      ++hits;
      worst = std::max(worst, contactError(c));
      ASSERT_FALSE(HasFailure()) << family.name << " " << trial;
    }
    std::printf("%-26s contact points off by %.1e in %d\n", family.name.c_str(), worst, hits);
    EXPECT_LE(worst, 4e-15) << family.name;
    EXPECT_GT(hits, 5) << family.name;
  }
}

/// Rounding left the corner out of what passes over either face: the points were 1.5 away.
TEST(TriangleContact, CornersThatMeetAreFoundInEveryOrderOfCoordinates) {
  const Case met{{Vector3d(-1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 1, -1)},
                 {Vector3d(1, 1, 1), Vector3d(-1, 0, 0), Vector3d(1, -1, 0)}};
  std::array<int, 3> order{0, 1, 2};
  do {
    const Case c{withCoordinates(met.a, order), withCoordinates(met.b, order)};
    const TriangleContact contact = triangleContact(c.a, c.b);
    EXPECT_LE((contact.point - c.a[0]).norm(), 1e-15);
    EXPECT_LE(contact.depth, 1e-15);
    EXPECT_LE(contactError(c), 1e-15);
    EXPECT_LE((triangleDistance(c.a, c.b).pointA - c.a[0]).norm(), 1e-15);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(TriangleContact, PointsLieOnTrianglesThatShareACorner) {
  Random random(20);
  double worst = 0.0;
  int merely = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Case c = lattice(random, trial);
    c.b[trial % 3] = c.a[trial / 3 % 3];
    worst = std::max(worst, contactError(c));
    ASSERT_FALSE(HasFailure()) << trial;
    merely += triangleContact(c.a, c.b).depth <= 1e-15 ? 1 : 0;
  }
  std::printf("%d of 20000 merely touch, contact points off by %.1e\n", merely, worst);
  EXPECT_LE(worst, 4e-15);
  EXPECT_GT(merely, 5000);
  EXPECT_LT(merely, 19000);
}

}  // namespace
}  // namespace swept
