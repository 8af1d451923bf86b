// SPDX-License-Identifier: BSD-3-Clause
// What is said about distances, against all pieces of all checked pairs one by one, with poses of
// the oracle's. A piece that a link cannot reach the world with is no matter of verdicts; it may be
// the nearest all the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "clearance_case.hpp"

namespace {

using namespace swept;

/// m. Poses of robots of a few metres, by us and by the oracle.
constexpr double kPoses = 1e-11;

struct Counts {
  int states = 0, motions = 0;
  int outOfReach = 0;  ///< of the states: the nearest piece is
  int contacts = 0;    ///< of the states
  int moving = 0, outOfReachMoving = 0;
  int hidden = 0;        ///< of the states: pairs of one kind are nearer, and there are others
  int hiddenMoving = 0;  ///< of the motions, likewise
};

class Clearances : public testing::TestWithParam<int> {
 protected:
  static std::filesystem::path folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("clearances_") + test->name();
    std::ranges::replace(name, '/', '_');
    auto made = std::filesystem::path(testing::TempDir()) / name;
    std::filesystem::create_directories(made);
    return made;
  }

  void askState(const ClearanceCase& one, Workspace& workspace, const std::vector<double>& q) {
    const ClearanceCase::Least truth = one.distanceAt(q);
    const StateReport report = one.checker().reportState(q, workspace);
    EXPECT_LE(report.clearance, truth.upper + kPoses) << truth.bodyA << " - " << truth.bodyB;
    EXPECT_GE(report.clearance, truth.lower - 1e-7);
    EXPECT_EQ(one.checker().clearance(q, workspace), report.clearance);
    if (std::isfinite(truth.upper)) {
      EXPECT_LE(one.distanceOf(report.nearestA, report.nearestB, report.nearestSelfPair, q),
                truth.upper + 1e-6);
    }
    for (const bool self : {false, true}) askKind(one, report, q, self);
    counts_.hidden += std::isfinite(report.world.clearance) && std::isfinite(report.self.clearance);
    askSigned(one, workspace, q, truth.upper);
    ++counts_.states;
    counts_.outOfReach += truth.outOfReach;
    counts_.contacts += truth.upper == 0.0;
  }

  static void askKind(const ClearanceCase& one, const StateReport& report,
                      const std::vector<double>& q, bool self) {
    const ClearanceCase::Least truth = one.distanceAt(q, self);
    const NearestPair& found = self ? report.self : report.world;
    EXPECT_LE(found.clearance, truth.upper + kPoses) << truth.bodyA << " - " << truth.bodyB;
    EXPECT_GE(found.clearance, truth.lower - 1e-7);
    EXPECT_EQ(found.bodyA.empty(), std::isinf(truth.upper));
    if (std::isfinite(truth.upper)) {
      EXPECT_LE(one.distanceOf(found.bodyA, found.bodyB, self, q), truth.upper + 1e-6);
    }
  }

  /// `distance` in m.
  static void askSigned(const ClearanceCase& one, Workspace& workspace,
                        const std::vector<double>& q, double distance) {
    const ClearanceCase::Least truth = one.signedDistanceAt(q);
    const SignedClearance found = one.checker().signedClearance(q, workspace);
    EXPECT_LE(found.lower, truth.upper + kPoses) << truth.bodyA << " - " << truth.bodyB;
    EXPECT_GE(found.lower, truth.lower - 1e-6);
    EXPECT_GE(found.upper, truth.lower - kPoses);
    if (distance > 0.0) {
      EXPECT_LE(found.upper, distance + 1e-6);
    }
  }

  void askMotion(ClearanceCase& one, Workspace& workspace, const std::vector<double>& from) {
    const std::vector<double> to = one.stateAfter(from);
    const double accuracy = 1e-3;
    const MotionClearance found = one.checker().motionClearance(from, to, accuracy, workspace);
    ++counts_.motions;
    if (std::isinf(found.lower)) {
      EXPECT_TRUE(one.checker().checkedPairs().empty());
      return;
    }
    EXPECT_LE(found.lower, found.upper);
    EXPECT_LE(found.upper - found.lower, accuracy + 1e-9);
    // Attained: so it is not below the least over the motion, nor is `lower` far below that.
    const std::vector<double> there = one.between(from, to, found.t);
    EXPECT_LE(one.distanceAt(there).upper, found.upper + 1e-9);
    for (const bool self : {false, true})
      askKind(one, self ? found.self : found.world, from, to, accuracy, self);
    counts_.hiddenMoving += std::isfinite(found.world.upper) && std::isfinite(found.self.upper);
    bool outOfReach = false;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kSamples; ++i) {
      const double t = i / static_cast<double>(kSamples);
      const ClearanceCase::Least truth = one.distanceAt(one.between(from, to, t));
      EXPECT_LE(found.lower, truth.upper + kPoses) << t;
      if (!(truth.upper < least)) continue;
      least = truth.upper;
      outOfReach = truth.outOfReach;
    }
    counts_.moving += found.lower > 0.0;
    counts_.outOfReachMoving += outOfReach && found.lower > 0.0;
  }

  static void askKind(ClearanceCase& one, const ClearanceInterval& found,
                      const std::vector<double>& from, const std::vector<double>& to,
                      double accuracy, bool self) {
    EXPECT_LE(found.lower, found.upper);
    if (std::isfinite(found.upper)) {
      EXPECT_LE(found.upper - found.lower, accuracy + 1e-9);
      const std::vector<double> there = one.between(from, to, found.t);
      EXPECT_LE(one.distanceAt(there, self).upper, found.upper + 1e-9);
      EXPECT_LE(one.distanceOf(found.bodyA, found.bodyB, self, there), found.upper + 1e-6);
    }
    for (int i = 0; i <= kSamples; ++i) {
      const double t = i / static_cast<double>(kSamples);
      EXPECT_LE(found.lower, one.distanceAt(one.between(from, to, t), self).upper + kPoses) << t;
    }
  }

  static constexpr int kSamples = 16;
  Counts counts_;
};

TEST_P(Clearances, AreOfAllPieces) {
  for (int i = 0; i < 50; ++i) {
    const auto seed = 1000 * static_cast<std::uint64_t>(GetParam()) + static_cast<std::uint64_t>(i);
    SCOPED_TRACE("seed " + std::to_string(seed));
    ClearanceCase one(seed, folder());
    Workspace workspace(one.checker());
    for (int k = 0; k < 12; ++k) {
      const std::vector<double> q = one.state();
      askState(one, workspace, q);
      if (k % 4 == 0) askMotion(one, workspace, q);
    }
  }
  EXPECT_GE(counts_.outOfReach, counts_.states / 15) << counts_.states;
  EXPECT_GE(counts_.contacts, counts_.states / 20) << counts_.states;
  EXPECT_LE(counts_.contacts, counts_.states / 2) << counts_.states;
  EXPECT_GE(counts_.moving, counts_.motions / 4) << counts_.motions;
  EXPECT_GE(counts_.outOfReachMoving, counts_.motions / 20) << counts_.motions;
  EXPECT_GE(counts_.hidden, counts_.states / 4) << counts_.states;
  EXPECT_GE(counts_.hiddenMoving, counts_.motions / 4) << counts_.motions;
}

INSTANTIATE_TEST_SUITE_P(Seeds, Clearances, testing::Values(1, 2, 3));

}  // namespace
