// SPDX-License-Identifier: BSD-3-Clause
// Each pair's own way to its answers against the general one: GJK, and EPA where cores overlap.
#include "narrowphase/convex_pair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "narrowphase/epa.hpp"
#include "pair_samples_all.hpp"

namespace swept::detail {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using samples::kNames;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kBounded = 8;  // of the variant, and convex

Convex convexOf(const Shape& shape) {
  return std::visit(
      [](const auto& body) -> Convex {
        if constexpr (ConvexShape<std::remove_cvref_t<decltype(body)>>) {
          return Convex::of(body);
        } else {
          return {};
        }
      },
      shape);
}

struct Interval {
  double lower;  ///< m
  double upper;  ///< m
};

GjkResult general(const Convex& a, const Convex& b, const Isometry3d& pose) {
  return gjk(a, b, pose, Vector3d::Zero(), Goal(kInfinity), 0.0, 1e-10, GjkMode::Exact);
}

/// Growing two cores by balls takes their radii off the signed distance.
Interval generalSigned(Convex a, Convex b, const Isometry3d& pose) {
  const double radii = a.radius + b.radius;
  a.radius = b.radius = 0.0;
  Simplex simplex;
  const GjkResult apart =
      gjk(a, b, pose, Vector3d::Zero(), Goal(kInfinity), 0.0, 1e-10, GjkMode::Exact, &simplex);
  if (apart.lower > 0.0) return {apart.lower - radii, apart.upper - radii};
  const EpaResult depth = epa(a, b, pose, simplex, 1e-10);
  return {-depth.upper - radii, std::max(-depth.lower, apart.upper) - radii};
}

class ConvexPairs : public testing::TestWithParam<std::tuple<std::size_t, std::size_t>> {
 protected:
  /// Calls `check` with samples of the pair; all that have closed forms get many.
  template <typename Check>
  void forSamples(unsigned seed, const Check& check) {
    const auto [kindA, kindB] = GetParam();
    samples::Sampler sampler(seed + static_cast<unsigned>(31 * kindA + kindB));
    const int cases = kindA <= 1 || (kindA == 3 && kindB == 3) ? 10000 : 2000;
    for (int i = 0; i < cases && !HasFailure(); ++i) {
      const samples::Pair p = sampler.pair(kindA, kindB, i);
      SCOPED_TRACE(testing::Message() << "sample " << i << " gap " << p.gap);
      check(p, convexOf(p.a), convexOf(p.b), 4e-14 * oracle::magnitude(p.a, p.b, p.a_from_b));
    }
  }
};

TEST_P(ConvexPairs, DistancesAreThoseOfGjk) {
  int apart = 0;
  int cases = 0;
  int wide = 0;
  forSamples(51, [&](const samples::Pair& p, const Convex& a, const Convex& b, double rounding) {
    const GjkResult own =
        convexPair(a, b, p.a_from_b, Vector3d::Zero(), Goal(kInfinity), 0.0, 1e-10, GjkMode::Exact);
    const GjkResult other = general(a, b, p.a_from_b);
    EXPECT_LE(own.lower, other.upper + rounding);
    EXPECT_LE(other.lower, own.upper + rounding);
    const double width = std::max(own.upper - own.lower, other.upper - other.lower);
    wide += width > 1e-9 + rounding;
    ++cases;
    apart += own.lower > 0.0;
  });
  EXPECT_LE(wide, cases / 30);
  EXPECT_GT(apart, cases / 4);
  EXPECT_LT(apart, 3 * cases / 4);
}

TEST_P(ConvexPairs, SignedDistancesAreThoseOfGjkAndEpa) {
  int overlapping = 0;
  int cases = 0;
  int wide = 0;
  forSamples(52, [&](const samples::Pair& p, const Convex& a, const Convex& b, double rounding) {
    const SignedDistanceResult own = convexPairSigned(a, b, p.a_from_b, 1e-10);
    const Interval other = generalSigned(a, b, p.a_from_b);
    EXPECT_LE(own.lower, other.upper + rounding);
    EXPECT_LE(other.lower, own.upper + rounding);
    wide += own.upper - own.lower > 1e-9 + rounding;
    ++cases;
    overlapping += own.upper < -rounding;
  });
  EXPECT_LE(wide, cases / 20);
  EXPECT_GT(overlapping, cases / 15);
  EXPECT_LT(overlapping, 3 * cases / 4);
}

/// A goal that is exceeded is proven along the normal given, and only then.
TEST_P(ConvexPairs, GoalsAreMetAlongTheNormal) {
  int met = 0;
  int cases = 0;
  forSamples(53, [&](const samples::Pair& p, const Convex& a, const Convex& b, double rounding) {
    for (const GjkMode mode : {GjkMode::Exact, GjkMode::GoalOnly, GjkMode::BoundOnly}) {
      ApproachBound approach;
      approach.linear = 0.05 * Vector3d(1.0, -2.0, 0.5);
      approach.travel = kInfinity;
      approach.required = 1e-3;
      const PartMotion still;
      const PartApproach goal(approach, still, still);
      const GjkResult r =
          convexPair(a, b, p.a_from_b, Vector3d::Zero(), Goal(goal), 0.0, 1e-9, mode);
      ++cases;
      if (!r.satisfied) continue;
      ++met;
      EXPECT_GT(r.lower, approach.along(r.normal));
      EXPECT_GE(oracle::slab(p.a, p.b, p.a_from_b, r.normal), r.lower - 0.1 * rounding);
    }
  });
  EXPECT_GT(met, cases / 50);
  EXPECT_LT(met, cases / 2);
}

std::vector<std::tuple<std::size_t, std::size_t>> boundedPairs() {
  std::vector<std::tuple<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < kBounded; ++a) {
    for (std::size_t b = a; b < kBounded; ++b) pairs.emplace_back(a, b);
  }
  return pairs;
}

INSTANTIATE_TEST_SUITE_P(Pairs, ConvexPairs, testing::ValuesIn(boundedPairs()),
                         [](const auto& names) {
                           return std::string(kNames[std::get<0>(names.param)]) +
                                  kNames[std::get<1>(names.param)];
                         });

}  // namespace
}  // namespace swept::detail
