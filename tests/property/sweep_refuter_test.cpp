// SPDX-License-Identifier: BSD-3-Clause
// Some thousand of the sweeps that sweep_refute makes by the million, and tests of the judge
// itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <stdexcept>
#include <string>

#include "sweeps/campaign.hpp"
#include "sweeps/gap.hpp"

namespace {

using namespace sweeps;
using swept::ContinuousResult;
using swept::Verdict;

TEST(SweepRefuter, FindsNothingToRefute) {
  CampaignOptions options;
  constexpr int kCount = 12 * kKinds * kKinds;
  options.count = kCount;
  const CampaignReport report = runCampaign(options);
  std::cout << summary(report) << std::endl;
  for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
  EXPECT_EQ(report.sweeps, options.count);
  // The suite says something only if it has all kinds of sweeps, and close calls.
  const auto share = [&](std::uint64_t n) { return static_cast<double>(n) / kCount; };
  EXPECT_GT(share(report.free), 0.3);
  EXPECT_GT(share(report.collision), 0.3);
  EXPECT_LT(share(report.undecided), 0.2);
  EXPECT_GT(share(report.contacts), 0.25);
  EXPECT_GT(share(report.mustBeFree), 0.1);
  EXPECT_GT(share(report.close), 0.2);
  EXPECT_LT(share(report.atStart), 0.2);
  EXPECT_GT(report.crossings, 5u);
  EXPECT_GT(report.symmetries, 100u);
  for (const std::uint64_t scene : report.scenes) EXPECT_GT(share(scene), 0.05);
  for (const auto& row : report.pairs)
    for (const std::uint64_t pairs : row) EXPECT_EQ(pairs, 12u);
  for (const auto& row : report.paths)
    for (const std::uint64_t paths : row) EXPECT_GE(paths, 20u);
}

Sweep firstWith(Scene scene, Verdict verdict, ContinuousResult& result) {
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    Sweep sweep = makeSweep(5, i);
    if (sweep.scene != scene || sweep.t < 0.1 || sweep.a.flat() || sweep.b.flat()) continue;
    const auto a = sweep.pathA.motion(), b = sweep.pathB.motion();
    result = continuousCollide(sweep.a.shape, *a, sweep.b.shape, *b, sweep.options);
    Random random(1, 1);
    const bool known = Judge(sweep).judge(result, random).contact;
    if (known && result.verdict == verdict && result.freeUntil > 0.05) return sweep;
  }
  throw std::runtime_error("none of 10 000 sweeps is " + std::string(toString(verdict)));
}

bool finds(const Sweep& sweep, const ContinuousResult& result, const std::string& what) {
  Random random(1, 1);
  const auto faults = Judge(sweep).judge(result, random).faults;
  return std::any_of(faults.begin(), faults.end(), [&](const std::string& fault) {
    return fault.find(what) != std::string::npos;
  });
}

/// A judge that never complains proves nothing: here are answers that are wrong.
TEST(SweepJudge, NoticesWrongAnswers) {
  ContinuousResult right;
  const Sweep sweep = firstWith(Scene::Crossing, Verdict::Collision, right);
  EXPECT_FALSE(finds(sweep, right, ""));
  ContinuousResult wrong = right;
  wrong.verdict = Verdict::Free;
  wrong.freeUntil = wrong.contactBy = 1.0;
  EXPECT_TRUE(finds(sweep, wrong, "MISSED"));
  wrong = right;
  wrong.pointA += 1e-9 * sweep.magnitude() * Vector3d(0.3, 0.5, 0.8);
  wrong.pointB -= 1e-9 * sweep.magnitude() * Vector3d(0.3, 0.5, 0.8);
  EXPECT_TRUE(finds(sweep, wrong, "witness"));
  wrong = right;
  std::swap(wrong.freeUntil, wrong.contactBy);
  EXPECT_TRUE(finds(sweep, wrong, "freeUntil is after contactBy"));
  wrong = right;
  wrong.freeUntil = std::nan("");
  EXPECT_TRUE(finds(sweep, wrong, "freeUntil is not in"));
  wrong = right;
  wrong.pointB.x() = INFINITY;
  EXPECT_TRUE(finds(sweep, wrong, "not finite"));
  // A proof that ends at the start, where there is still room.
  wrong = right;
  wrong.freeUntil = 0.0;
  EXPECT_TRUE(finds(sweep, wrong, "tolerances beyond the margin"));
}

/// Hulls a million times as long as they are wide, at which a search for the nearest point stalls.
TEST(SweepJudge, KnowsThePointsOfNeedles) {
  int inside = 0, ahead = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    Random random(8, i);
    std::vector<Vector3d> points;
    for (int k = 0; k < 7; ++k) {
      points.push_back(100.0 * random.direction().cwiseProduct(Vector3d(1e-6, 1.0, 1e-6)));
    }
    Body needle;
    needle.kind = Kind::Hull;
    needle.shape = swept::ConvexHull::of(points);
    needle.parts.push_back({.points = points});
    const double rounding = 1e-14 * 100.0;
    for (int k = 0; k < 20; ++k) {
      const double u = random.uniform(0.0, 1.0), v = random.uniform(0.0, 1.0 - u);
      const Vector3d p = u * points[0] + v * points[1] + (1.0 - u - v) * points[2];
      inside += outside(needle, p) <= rounding ? 1 : 0;
      const Vector3d n = random.across(Vector3d::UnitY());
      const double off = random.uniform(1e-9, 1e-6);
      const Vector3d q = needle.parts[0].support(n) + off * n;
      ahead += std::abs(outside(needle, q) - off) <= rounding ? 1 : 0;
    }
  }
  EXPECT_EQ(inside, 400 * 20);
  EXPECT_EQ(ahead, 400 * 20);
}

/// The descent finds contacts that nobody constructed.
TEST(SweepJudge, RefutesWithoutBeingTold) {
  int refuted = 0, asked = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Sweep sweep = makeSweep(6, i);
    if (sweep.scene != Scene::Anywhere) continue;
    const auto a = sweep.pathA.motion(), b = sweep.pathB.motion();
    ContinuousResult result =
        continuousCollide(sweep.a.shape, *a, sweep.b.shape, *b, sweep.options);
    if (result.verdict != Verdict::Collision || result.contactBy > 0.9) continue;
    ++asked;
    result.verdict = Verdict::Free;
    result.freeUntil = result.contactBy = 1.0;
    if (finds(sweep, result, "REFUTED")) ++refuted;
  }
  EXPECT_GT(asked, 30);
  EXPECT_GT(refuted, 0.3 * asked);
}

/// Undecided is no answer where there is room.
TEST(SweepJudge, NoticesTimidAnswers) {
  int noticed = 0, asked = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Sweep sweep = makeSweep(7, i);
    if (!sweep.mustBeFree || sweep.options.timeTolerance > 0.0) continue;
    ++asked;
    ContinuousResult timid;
    if (finds(sweep, timid, "by construction") && finds(sweep, timid, "no sample after")) ++noticed;
  }
  EXPECT_GT(asked, 40);
  EXPECT_GT(noticed, 0.9 * asked);
}

}  // namespace
