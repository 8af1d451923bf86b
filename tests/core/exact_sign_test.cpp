// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/exact_sign.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "geometry/product_error.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;
using Rational = boost::multiprecision::cpp_rational;

int signOf(const Rational& x) {
  return x > 0 ? 1 : (x < 0 ? -1 : 0);
}

Rational difference(const Vector3d& x, const Vector3d& y, int i) {
  return Rational(x[i]) - Rational(y[i]);
}

int trueSideOfLine(const Vector3d& a, const Vector3d& b, const Vector3d& c, int i, int j) {
  return signOf(difference(b, a, i) * difference(c, a, j) -
                difference(b, a, j) * difference(c, a, i));
}

int trueSideOfPlane(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& p) {
  Rational sum = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    sum += difference(p, a, i) *
           (difference(b, a, j) * difference(c, a, k) - difference(b, a, k) * difference(c, a, j));
  }
  return signOf(sum);
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double within(double reach) {
    return std::uniform_real_distribution<double>(-reach, reach)(engine_);
  }
  int integer(int reach) { return std::uniform_int_distribution<int>(-reach, reach)(engine_); }
  Vector3d point(double reach) { return {within(reach), within(reach), within(reach)}; }

 private:
  std::mt19937 engine_;
};

/// Factors of all sizes whose product and its error are doubles, with many and with few bits.
TEST(ProductError, IsWhatTheProductHasLost) {
  Random random(7);
  int exact = 0, all = 0;
  for (int i = 0; i < 20000; ++i) {
    const bool few = random.integer(1) == 0;
    const auto factor = [&] {
      const double mantissa = few ? random.integer(1 << 20) : random.within(1.0);
      return std::ldexp(mantissa, random.integer(450));
    };
    const double x = factor(), y = factor(), product = x * y;
    const Rational lost = Rational(x) * Rational(y) - Rational(product);
    ASSERT_EQ(Rational(productError(x, y, product)), lost) << x << " * " << y;
    ASSERT_EQ(Rational(dekkerProductError(x, y, product)), lost) << x << " * " << y;
    exact += lost == 0 ? 1 : 0;
    ++all;
  }
  EXPECT_GT(exact, all / 10);
  EXPECT_LT(exact, all * 9 / 10);
  // Not finite, so that a filter does not decide.
  EXPECT_FALSE(std::isfinite(dekkerProductError(0x1p1000, 0x1p-1000, 1.0)));
}

/// Counts of what a suite has met, so that it can show that it met everything.
struct Tally {
  int zero = 0;
  int notFiltered = 0;
  int notRefined = 0;
  int all = 0;

  void expectRightSide(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& p) {
    const int truth = trueSideOfPlane(a, b, c, p);
    ASSERT_EQ(sideOfPlane(a, b, c, p), truth);
    ASSERT_EQ(sideOfPlane(b, c, a, p), truth);
    ASSERT_EQ(sideOfPlane(b, a, c, p), -truth);
    ASSERT_EQ(sideOfPlane(p, b, a, c), truth);
    const FilteredSign filtered = filteredSideOfPlane(a, b, c, p);
    const FilteredSign refined = refinedSideOfPlane(a, b, c, p);
    if (filtered != FilteredSign::Unknown) {
      ASSERT_EQ(static_cast<int>(filtered), truth);
    }
    if (refined != FilteredSign::Unknown) {
      ASSERT_EQ(static_cast<int>(refined), truth);
    }
    ++all;
    zero += truth == 0 ? 1 : 0;
    notFiltered += filtered == FilteredSign::Unknown ? 1 : 0;
    notRefined += refined == FilteredSign::Unknown ? 1 : 0;
  }
};

TEST(ExactSign, DecidesGridsOfLastPlacesAroundAPlane) {
  // Kettner, Mehlhorn, Pion, Schirra, Yap 2008, "Classroom examples of robustness problems", one
  // dimension up: doubles get most of such a picture wrong.
  const double step = std::ldexp(1.0, -53);
  const Vector3d a(12.0, 12.0, 12.0);
  const Vector3d b(24.0, 24.0, 24.0);
  const Vector3d c(18.5, -18.5, 0.0);
  Tally tally;
  int roundedWrong = 0;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) {
      const int k = (i + j) / 2 + (i * 7 + j) % 3 - 1;
      const Vector3d p(0.5 + i * step, 0.5 + j * step, 0.5 + k * step);
      tally.expectRightSide(a, b, c, p);
      const double rounded = (b - a).cross(c - a).dot(p - a);
      const int sign = rounded > 0.0 ? 1 : (rounded < 0.0 ? -1 : 0);
      roundedWrong += sign != trueSideOfPlane(a, b, c, p) ? 1 : 0;
    }
  }
  EXPECT_EQ(tally.notFiltered, tally.all);
  EXPECT_GT(tally.zero, tally.all / 10);
  EXPECT_GT(roundedWrong, tally.all / 5);
}

TEST(ExactSign, DecidesPointsPutOnAPlaneUpToRounding) {
  Random random(3);
  Tally tally;
  for (int trial = 0; trial < 4000; ++trial) {
    const double scale = std::pow(10.0, random.within(12.0));
    const Vector3d a = random.point(scale);
    const Vector3d b = a + random.point(scale * std::pow(10.0, random.within(4.0)));
    const Vector3d c = a + random.point(scale * std::pow(10.0, random.within(4.0)));
    const double s = random.within(1.0), t = random.within(1.0);
    const Vector3d p = a + s * (b - a) + t * (c - a);
    tally.expectRightSide(a, b, c, p);
  }
  EXPECT_GT(tally.notFiltered, tally.all / 2);
}

TEST(ExactSign, DecidesExactlyCoplanarPoints) {
  Random random(4);
  Tally tally;
  for (int trial = 0; trial < 4000; ++trial) {
    // On a lattice that doubles hold, but whose height terms do not vanish one by one.
    const auto step = [&](int reach) -> double { return random.integer(reach); };
    const Vector3d u{step(1000), step(1000), step(1000)};
    const Vector3d v{step(1000), step(1000), step(1000)};
    const Vector3d origin{step(1 << 30), step(1 << 30), 0x1p-20};
    const auto somewhere = [&]() -> Vector3d {
      const int s = random.integer(9), t = random.integer(9);
      return std::ldexp(1.0, trial % 200 - 100) * (origin + s * u + t * v);
    };
    const Vector3d a = somewhere();
    const Vector3d b = somewhere();
    const Vector3d c = somewhere();
    Vector3d p = somewhere();
    if (trial % 2 == 0) p.x() = std::nextafter(p.x(), 1e30);
    tally.expectRightSide(a, b, c, p);
  }
  EXPECT_GT(tally.zero, tally.all / 3);
  EXPECT_LT(tally.zero, tally.all * 7 / 10);
  EXPECT_GE(tally.notRefined, tally.zero);
}

TEST(ExactSign, HoldsUpToTheEndsOfItsRange) {
  Random random(5);
  int zero = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const auto coordinate = [&] {
      if (random.integer(1) == 0) return 0.0;
      const double magnitude = random.integer(1) > 0 ? kExactGreatest : kExactLeast;
      const double share = 1.0 + 1e-3 * random.integer(9);
      return (random.integer(1) > 0 ? 1.0 : -1.0) * (magnitude > 1.0
                                                         ? magnitude / (1.0 + std::abs(share - 1.0))
                                                         : magnitude * share * 1.01);
    };
    const auto point = [&] { return Vector3d{coordinate(), coordinate(), coordinate()}; };
    const Vector3d a = point();
    const Vector3d b = point();
    const Vector3d c = point();
    const Vector3d p = point();
    ASSERT_TRUE(withinExactRange(a) && withinExactRange(b));
    ASSERT_EQ(sideOfPlane(a, b, c, p), trueSideOfPlane(a, b, c, p));
    ASSERT_EQ(sideOfLine(a, b, c, 0, 2), trueSideOfLine(a, b, c, 0, 2));
    zero += sideOfPlane(a, b, c, p) == 0 ? 1 : 0;
  }
  EXPECT_GT(zero, 100);
  EXPECT_LT(zero, 3000);
}

TEST(ExactSign, KnowsItsRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(withinExactRange({0.0, -0.0, 1e90}));
  EXPECT_TRUE(withinExactRange({-1e-90, 1.0, -1e90}));
  EXPECT_FALSE(withinExactRange({0.0, 0.0, 1.1e90}));
  EXPECT_FALSE(withinExactRange({0.9e-90, 0.0, 0.0}));
  EXPECT_FALSE(withinExactRange({0.0, nan, 0.0}));
  EXPECT_FALSE(withinExactRange({-infinity, 0.0, 0.0}));
}

TEST(ExactSign, FilterTellsNothingWhereItOverflowsOrUnderflows) {
  for (const double scale : {1e-160, 1e-320, 1e150, 1e300}) {
    const auto sign = filteredSideOfPlane(Vector3d::Zero(), scale * Vector3d::UnitX(),
                                          scale * Vector3d::UnitY(), scale * Vector3d::UnitZ());
    EXPECT_EQ(sign, FilteredSign::Unknown) << scale;
  }
}

TEST(ExactSign, DecidesSidesOfLinesAtLastPlaces) {
  const double step = std::ldexp(1.0, -53);
  const Vector3d a(12.0, 0.0, 12.0);
  const Vector3d b(24.0, 0.0, 24.0);
  int zero = 0;
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const Vector3d p(0.5 + i * step, 0.0, 0.5 + j * step);
      const int truth = trueSideOfLine(a, b, p, 2, 0);
      ASSERT_EQ(sideOfLine(a, b, p, 2, 0), truth);
      ASSERT_EQ(sideOfLine(b, a, p, 2, 0), -truth);
      ASSERT_EQ(sideOfLine(p, a, b, 2, 0), truth);
      zero += truth == 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(zero, 64);
}

}  // namespace
}  // namespace swept::detail
