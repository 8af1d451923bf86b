// SPDX-License-Identifier: BSD-3-Clause
// Some thousand of the pairs that pair_refute makes by the million, and tests of the judge itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <string>

#include "pairs/campaign.hpp"

namespace {

using namespace pairs;

constexpr std::uint64_t kAll = kKinds * kKinds;

TEST(PairRefuter, FindsNothingToRefute) {
  CampaignOptions options;
  options.count = 12 * kAll;
  const CampaignReport report = runCampaign(options);
  std::cout << summary(report) << std::endl;
  for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
  // The suite says something only if it has all pairs of kinds, of all sizes, and close calls.
  const auto share = [&](std::uint64_t n) {
    return static_cast<double>(n) / static_cast<double>(report.placings);
  };
  EXPECT_EQ(report.placings, options.count * options.placings);
  EXPECT_GT(share(report.apart), 0.3);
  EXPECT_GT(share(report.touching), 0.3);
  EXPECT_GT(share(report.near), 0.05);
  EXPECT_GT(share(report.within), 0.2);
  EXPECT_GT(share(report.bounded), 0.1);
  EXPECT_GT(report.exact, 15u);
  for (const auto& row : report.pairs)
    for (const std::uint64_t placings : row) EXPECT_EQ(placings, 12u * options.placings);
  for (std::size_t i = 0; i < report.apartOf.size(); ++i) {
    for (std::size_t j = 0; j < report.apartOf.size(); ++j)
      EXPECT_GE(report.apartOf[i][j], 1u) << sweeps::kKindNames[i] << ", " << sweeps::kKindNames[j];
  }
  for (const std::uint64_t placings : report.decades) EXPECT_GT(share(placings), 0.01);
}

/// Most of what is special about them is in the triangles: hulls beside open surfaces with needles,
/// some of which have two corners that are the same to the last bit.
TEST(PairRefuter, FindsNothingToRefuteOfHullsAndOpenMeshes) {
  CampaignOptions options;
  options.count = 2000;
  options.seed = 3;
  options.kindA = static_cast<int>(Kind::Hull);
  options.kindB = static_cast<int>(Kind::OpenMesh);
  const CampaignReport report = runCampaign(options);
  std::cout << summary(report) << std::endl;
  for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
  EXPECT_GT(report.apart, report.placings / 5);
  EXPECT_GT(report.near, report.placings / 40);
  int lines = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    Random random(0, 0);
    const Pair pair = makePair(
        3, i * kAll + static_cast<std::uint64_t>(options.kindA * kKinds + options.kindB), random);
    for (const sweeps::Part& part : pair.b.parts) {
      const auto& p = part.points;
      lines += p[0] == p[1] || p[1] == p[2] || p[2] == p[0] ? 1 : 0;
    }
  }
  EXPECT_GT(lines, 50);
}

/// A judge that never complains proves nothing: here are answers that are wrong.
TEST(PairJudge, NoticesWrongAnswers) {
  int judged = 0;
  for (std::uint64_t index = 0; index < kAll; ++index) {
    Random random(0, 0);
    const Pair pair = makePair(9, index, random);
    const Placing placing = place(pair, random);
    const Answer right = ask(pair, placing);
    if (!(right.distance.lower > 0.0) || (pair.a.flat() && pair.b.flat())) continue;
    ++judged;
    const auto finds = [&](const Answer& answer) {
      return !faultsOf(pair, placing, answer).empty();
    };
    EXPECT_FALSE(finds(right)) << index;
    const double most = placing.atMost.convert_to<double>();
    const double more = std::nextafter(most, std::numeric_limits<double>::infinity());
    Answer wrong = right;
    wrong.distance.lower = wrong.distance.upper = more;
    EXPECT_TRUE(finds(wrong)) << index;
    wrong = right;
    wrong.signedDistance.lower = wrong.signedDistance.upper = more;
    EXPECT_TRUE(finds(wrong)) << index;
    wrong = right;
    wrong.keepsMore = true;
    EXPECT_TRUE(finds(wrong)) << index;
    wrong = right;
    std::swap(wrong.distance.lower, wrong.distance.upper);
    EXPECT_TRUE(finds(wrong) || right.distance.lower == right.distance.upper) << index;
    if (placing.atLeast > 1e-6 * std::max(pair.sizeA, pair.sizeB)) {
      wrong = right;
      wrong.distance.lower = 0.0;
      wrong.distance.upper = 0.5 * placing.atLeast;
      EXPECT_TRUE(finds(wrong)) << index;
      wrong = right;
      wrong.contact = swept::Contact::Touching;
      EXPECT_TRUE(finds(wrong)) << index;
    }
  }
  EXPECT_GT(judged, 50);
}

}  // namespace
