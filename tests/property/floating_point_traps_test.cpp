// SPDX-License-Identifier: BSD-3-Clause
// Answers about robots make no NaN and no infinity on their way that they would have to get rid of
// again.
#include "floating_point_traps.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "models_under_test.hpp"
#include "random_motions.hpp"
#include "simd_targets.hpp"

namespace {

using namespace swept;
using swept::test::FloatingPointTraps;

class TrappedRobot : public testing::TestWithParam<Model> {};

TEST_P(TrappedRobot, AnswersWithoutNaN) {
  if (!FloatingPointTraps::areSupported()) GTEST_SKIP() << "the processor has no traps";
  std::array<int, 3> seen{};
  const std::vector<std::int64_t> targets = swept::simd_test::simdTargets();
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Scenario scenario = clutterScenario(filesOf(GetParam()), seed);
    const Checker& checker = *scenario.checker;
    Workspace workspace(checker);
    RandomMotions motions(scenario, seed, 2.0);
    for (int i = 0; i < 100; ++i) {
      SCOPED_TRACE(std::to_string(seed) + " " + std::to_string(i));
      const auto [start, goal] = motions.next();
      const std::vector<double> from = scenario.groupOf(start);
      const std::vector<double> to = scenario.groupOf(goal);
      const swept::simd_test::OnTarget on(targets[static_cast<std::size_t>(i) % targets.size()]);
      const FloatingPointTraps traps;
      ++seen[static_cast<std::size_t>(checker.certifyMotion(from, to, workspace).verdict)];
      (void)checker.checkState(from, workspace);
      (void)checker.reportState(to, workspace);
      (void)checker.clearance(from, workspace);
      (void)checker.signedClearance(to, workspace);
      if (i % 10 == 0) (void)checker.motionClearance(from, to, 1e-3, workspace);
    }
  }
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::Free)], 40);
  EXPECT_GT(seen[static_cast<std::size_t>(Verdict::Collision)], 40);
}

INSTANTIATE_TEST_SUITE_P(FloatingPointTraps, TrappedRobot, modelsUnderTest(), modelName);

}  // namespace
