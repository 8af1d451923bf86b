// SPDX-License-Identifier: BSD-3-Clause
// Queries between all kinds of shapes, ordinary and degenerate, make no NaN and no infinity on
// their way that they would have to get rid of again.
#include "floating_point_traps.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "pair_samples_all.hpp"
#include "simd_targets.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept {
namespace {

using samples::kNames;
using samples::Pair;
using samples::Sampler;
using test::FloatingPointTraps;

TEST(FloatingPointTraps, EndTheProcess) {
#if defined(__x86_64__)
  ASSERT_TRUE(FloatingPointTraps::areSupported());
#endif
  if (!FloatingPointTraps::areSupported()) GTEST_SKIP() << "the processor has no traps";
  const auto divide = [](double a, double b) {
    const FloatingPointTraps traps;
    volatile const double divisor = b;  // or the compiler divides before
    std::exit(a / divisor > 0.0 ? 1 : 2);
  };
  EXPECT_EXIT(divide(0.0, 0.0), testing::KilledBySignal(SIGFPE), "");
  EXPECT_EXIT(divide(1.0, 0.0), testing::KilledBySignal(SIGFPE), "");
  EXPECT_EXIT(divide(1e300, 1e-300), testing::KilledBySignal(SIGFPE), "");
  EXPECT_EXIT(divide(2.0, 3.0), testing::ExitedWithCode(1), "");
}

class TrappedPair : public testing::TestWithParam<std::size_t> {};

TEST_P(TrappedPair, AnswersWithoutNaN) {
  if (!FloatingPointTraps::areSupported()) GTEST_SKIP() << "the processor has no traps";
  Sampler sampler(31 + static_cast<unsigned>(GetParam()));
  const std::vector<std::int64_t> targets = simd_test::simdTargets();
  int apart = 0;
  int all = 0;
  for (std::size_t other = 0; other < kNames.size(); ++other) {
    for (int i = 0; i < 40; ++i) {
      const Pair p = sampler.pair(GetParam(), other, i);
      SCOPED_TRACE(std::string(kNames[other]) + " " + std::to_string(i));
      const simd_test::OnTarget on(targets[static_cast<std::size_t>(i) % targets.size()]);
      const FloatingPointTraps traps;
      apart += distance(p.a, p.b, p.a_from_b).lower > 0.0 ? 1 : 0;
      (void)signedDistance(p.a, p.b, p.a_from_b);
      (void)collide(p.a, p.b, p.a_from_b);
      ++all;
    }
  }
  EXPECT_GT(apart, all / 10);
  EXPECT_LT(apart, all * 9 / 10);
}

INSTANTIATE_TEST_SUITE_P(FloatingPointTraps, TrappedPair,
                         testing::Range(std::size_t{0}, kNames.size()),
                         [](const auto& tested) { return std::string(kNames[tested.param]); });

}  // namespace
}  // namespace swept
