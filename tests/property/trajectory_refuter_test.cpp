// SPDX-License-Identifier: BSD-3-Clause
// Some hundred of the curves that trajectory_refute makes by the million, and tests of the judge.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

#include "trajectories/campaign.hpp"
#include "trajectories/errors.hpp"
#include "trajectories/judge.hpp"

namespace {

using namespace trajectories;

TEST(TrajectoryRefuter, FindsNothingToRefute) {
  CampaignOptions options;
  options.count = scenes().size() * kTubes * kCurvesOfStage;
  options.samples = 1500;
  const CampaignReport report = runCampaign(options);
  std::cout << summary(report) << std::endl;
  for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
  const auto share = [](std::uint64_t n, const Tally& of) {
    return static_cast<double>(n) / static_cast<double>(of.curves);
  };
  EXPECT_GT(share(report.all.free, report.all), 0.2);
  EXPECT_LT(share(report.all.free, report.all), 0.8);
  EXPECT_GT(20 * report.near, report.all.free);
  EXPECT_LE(share(report.narrow.undecided, report.narrow), 0.01);
  for (const Tally& tally : report.kinds) EXPECT_GT(tally.free * tally.collision, 0U);
  for (const Tally& tally : report.scenes) EXPECT_GT(tally.free * tally.collision, 0U);
  EXPECT_GT(share(report.beside, report.all), 0.02);
  EXPECT_GT(share(report.prefixes, report.all), 0.02);
  EXPECT_GT(share(report.tooFast, report.all), 0.05);
  EXPECT_GT(share(report.outside, report.all), 0.02);
}

/// What is asked of each of some curves, with a judge beside it.
template <typename Look>
void forSomeCurves(const Look& look) {
  constexpr std::uint64_t kEach = 6;
  for (std::uint64_t index = 0; index < scenes().size() * kTubes; ++index) {
    const Stage stage = makeStage(5, index);
    swept::Workspace workspace(stage.checker), plain(stage.plain);
    for (std::uint64_t i = 0; i < kEach; ++i) {
      Random random(5, kEach * index + i);
      const RandomCurve curve = makeCurve(stage, workspace, plain, random);
      swept::TrajectoryQuery query;
      query.limits.emplace();
      for (std::size_t k = 0; k < stage.values(); ++k) {
        query.limits->velocity.push_back(0.1);
        query.limits->acceleration.push_back(1.0);
        query.limits->jerk.push_back(10.0);
      }
      look(stage, curve, query, stage.checker.certifyTrajectory(curve.curve, workspace, query),
           random);
    }
  }
}

/// A judge that never complains proves nothing: here are answers that are wrong.
TEST(TrajectoryJudge, NoticesWrongAnswers) {
  int collisions = 0, freed = 0, late = 0, prefixes = 0;
  forSomeCurves([&](const Stage& stage, const RandomCurve& curve,
                    const swept::TrajectoryQuery& query, const swept::TrajectoryCertificate& right,
                    Random& random) {
    const auto finds = [&](const swept::TrajectoryCertificate& answer) {
      Judge judge(stage, 3000, random);
      Judged judged;
      return !judge.faultsOf(curve, query, answer, judged).empty();
    };
    EXPECT_FALSE(finds(right)) << stage.scene;
    swept::TrajectoryCertificate wrong = right;
    if (right.verdict != swept::Verdict::Collision) {
      wrong.verdict = swept::Verdict::Collision;
      EXPECT_TRUE(finds(wrong)) << stage.scene;
      return;
    }
    ++collisions;
    wrong.verdict = swept::Verdict::Free;
    wrong.freeUntil = curve.curve.end();
    wrong.contact.reset();
    freed += finds(wrong) ? 1 : 0;
    wrong = right;
    wrong.freeUntil = curve.curve.end();
    if (right.freeUntil > curve.curve.begin()) {
      ++prefixes;
      late += finds(wrong) ? 1 : 0;
    }
    wrong = right;
    for (const StageJoint& joint : stage.joints)
      wrong.contact->configuration[static_cast<Eigen::Index>(joint.first)] +=
          2.1 * std::max(joint.tolerance.rotation, joint.tolerance.translation) + 1e-6;
    EXPECT_TRUE(finds(wrong)) << stage.scene;
  });
  EXPECT_GT(collisions, 40);
  EXPECT_GT(prefixes, 15);
  EXPECT_GT(10 * freed, 9 * collisions);
  EXPECT_GT(10 * late, 8 * prefixes);
}

TEST(TrajectoryJudge, NoticesWrongLimits) {
  int listed = 0;
  forSomeCurves([&](const Stage& stage, const RandomCurve& curve,
                    const swept::TrajectoryQuery& query, const swept::TrajectoryCertificate& right,
                    Random& random) {
    const auto finds = [&](const swept::TrajectoryCertificate& answer) {
      return !limitFaults(stage, curve, *query.limits, answer).empty();
    };
    EXPECT_FALSE(finds(right)) << stage.scene;
    if (right.violations.empty()) return;
    ++listed;
    const auto which = static_cast<std::size_t>(random.below(right.violations.size()));
    swept::TrajectoryCertificate wrong = right;
    wrong.violations[which].value *= 1.0 + 1e-4;
    EXPECT_TRUE(finds(wrong)) << stage.scene;
    wrong = right;
    wrong.violations[which].value *= 1.0 - 1e-4;
    EXPECT_TRUE(finds(wrong)) << stage.scene;
    wrong = right;
    wrong.violations.push_back(right.violations[which]);
    EXPECT_TRUE(finds(wrong)) << stage.scene;
    wrong = right;
    const double most = std::abs(right.violations[which].value);
    const bool clear = most > 1.01 * std::abs(right.violations[which].limit);
    wrong.violations.erase(wrong.violations.begin() + static_cast<std::ptrdiff_t>(which));
    EXPECT_TRUE(finds(wrong) || !clear) << stage.scene;
  });
  EXPECT_GT(listed, 60);
}

}  // namespace
