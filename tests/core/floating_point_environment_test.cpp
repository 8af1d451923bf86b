// SPDX-License-Identifier: BSD-3-Clause
// A program that rounds upward, or takes denormals for zero, was answered by arithmetic that the
// proofs do not speak of: two balls about one point were "proven" apart, since a cloud's boxes in
// single precision, made for rounding to nearest, did not contain its points.
#include "swept/core/floating_point_environment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

#include "foreign_environment.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/point_cloud.hpp"

namespace swept {
namespace {

using test::Environment;
using test::foreignEnvironments;
using test::leavesAlone;

/// What a thread's arithmetic does.
struct Arithmetic {
  double above, below;      ///< of 1 + and - a quarter of its last place
  bool flushes, ignores;    ///< denormal results, denormal operands
  long double longPrecise;  ///< of 1 and half of the last place that it has
  bool operator==(const Arithmetic&) const = default;
};

[[gnu::noinline]] Arithmetic arithmetic() {
  volatile double one = 1.0, tiny = 1e-17, least = std::numeric_limits<double>::min();
  volatile double denormal = std::numeric_limits<double>::denorm_min();
  volatile long double longOne = 1.0L, longTiny = 1e-21L;
  volatile double half = 0.5;
  volatile double halved = least * half;
  volatile double doubled = denormal + denormal;
  return {one + tiny, one - tiny, std::fpclassify(halved) == FP_ZERO,
          std::fpclassify(doubled) == FP_ZERO, longOne + longTiny};
}

TEST(FloatingPointEnvironment, IsTheDefaultForWhatIsCalledInIt) {
  const Arithmetic usual = arithmetic();
  for (const Environment& environment : foreignEnvironments()) {
    SCOPED_TRACE(environment.name);
    Arithmetic inside{}, outside{}, nested{};
    EXPECT_TRUE(leavesAlone(environment, [&] {
      outside = arithmetic();
      inDefaultEnvironment([&] {
        inside = arithmetic();
        nested = inDefaultEnvironment([] { return arithmetic(); });
      });
    }));
    EXPECT_FALSE(outside == usual) << "the test sets nothing";
    EXPECT_TRUE(inside == usual);
    EXPECT_TRUE(nested == usual);
  }
}

TEST(FloatingPointEnvironment, ComesBackAfterAnException) {
  for (const Environment& environment : foreignEnvironments()) {
    SCOPED_TRACE(environment.name);
    EXPECT_TRUE(leavesAlone(environment, [] {
      EXPECT_THROW(inDefaultEnvironment([]() -> int { throw std::runtime_error("stop"); }),
                   std::runtime_error);
    }));
  }
}

TEST(FloatingPointEnvironment, GivesBackWhatCanOnlyBeMoved) {
  EXPECT_TRUE(leavesAlone(foreignEnvironments().front(), [] {
    const auto seven = inDefaultEnvironment([] { return std::make_unique<int>(7); });
    EXPECT_EQ(*seven, 7);
  }));
}

TEST(FloatingPointEnvironment, KeepsFlagsAndMasks) {
  for (const Environment& environment : foreignEnvironments()) {
    SCOPED_TRACE(environment.name);
    bool overflow = false, division = false;
    EXPECT_TRUE(leavesAlone(environment, [&] {
      std::feclearexcept(FE_ALL_EXCEPT);
      std::feraiseexcept(FE_OVERFLOW);
      inDefaultEnvironment([] {
        volatile double one = 1.0, zero = 0.0;
        volatile double infinite = one / zero;
        (void)infinite;
      });
      overflow = std::fetestexcept(FE_OVERFLOW) != 0;
      division = std::fetestexcept(FE_DIVBYZERO) != 0;
    }));
    EXPECT_TRUE(overflow) << "raised before";
    EXPECT_TRUE(division) << "raised within";
  }
}

TEST(FloatingPointEnvironment, IsPassedOnToThreads) {
  const Arithmetic usual = arithmetic();
  Arithmetic inside{};
  EXPECT_TRUE(leavesAlone(foreignEnvironments().front(), [&] {
    inDefaultEnvironment([&] { std::jthread([&] { inside = arithmetic(); }); });
  }));
  EXPECT_TRUE(inside == usual);
}

#if defined(__x86_64__)
void setLongControl(std::uint16_t control) {
  __asm__ volatile("fldcw %0" : : "m"(control) : "memory");
}

TEST(FloatingPointEnvironment, HasTheWholePrecisionOfLongDouble) {
  const Arithmetic usual = arithmetic();
  Arithmetic inside{};
  setLongControl(0x027F);  // 53 bits, as some libraries set for good
  const bool foreign = detail::inForeignPrecision();
  volatile long double one = 1.0L, tiny = 1e-18L;
  volatile bool lost = one + tiny == one;
  inDefaultEnvironment([&] { inside = arithmetic(); });
  const bool still = detail::inForeignPrecision();
  setLongControl(0x037F);
  EXPECT_TRUE(foreign);
  EXPECT_TRUE(lost);
  EXPECT_TRUE(still);
  EXPECT_TRUE(inside == usual);
}
#endif

/// Two balls about one point, one of a cloud whose bucket is a kilometre wide.
TEST(FloatingPointEnvironment, LeavesNoBallsApartThatAreOne) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    const double far = 1000.0 * (1.0 + unit(random)) * (unit(random) < 0.5 ? -1.0 : 1.0);
    const std::vector<Eigen::Vector3d> many{{0, 0, 0}, {far, 0, 0}, {0, std::abs(far), 0}};
    const std::vector<Eigen::Vector3d> one{{far, 0, 0}};
    const double radius = 1e-9 * std::exp(unit(random) * std::log(1e5));
    for (const Environment& environment : foreignEnvironments()) {
      SCOPED_TRACE(environment.name);
      DistanceResult found;
      Contact contact = Contact::Unknown;
      EXPECT_TRUE(leavesAlone(environment, [&] {
        const Shape a = PointCloud::build(many, radius);
        const Shape b = PointCloud::build(one, radius);
        found = distance(a, b, Eigen::Isometry3d::Identity());
        contact = collide(a, b, Eigen::Isometry3d::Identity());
      }));
      ASSERT_EQ(found.lower, 0.0);
      ASSERT_NE(contact, Contact::Separate);
    }
  }
}

}  // namespace
}  // namespace swept
