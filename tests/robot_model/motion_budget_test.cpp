// SPDX-License-Identifier: BSD-3-Clause
// The cap on intervals is one for the whole motion, however often an obstacle turns during it. It
// was one for each part between two turns: 500 intervals where 10 were allowed.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <memory>
#include <string>

#include "swept/robot_model/checker.hpp"

namespace swept {
namespace {

constexpr double kTurns = 50.0;

constexpr const char* kSlide = R"(<robot name="slide"><link name="base"/>
  <link name="ball"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
  <joint name="z" type="prismatic"><parent link="base"/><child link="ball"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>)";

/// A ball that stands, and one that passes it 50 times, once a second, with a gap smaller than the
/// tolerance (`gap` in m): which no number of intervals settles.
Checker grazing(int maxIntervals, double gap) {
  MovingObstacle obstacle;
  obstacle.name = "shuttle";
  obstacle.parts.push_back({Sphere{0.05}, Eigen::Isometry3d::Identity()});
  for (int i = 0; i <= static_cast<int>(kTurns); ++i) {
    const Eigen::Translation3d place(i % 2 == 0 ? -1.0 : 1.0, 0.1 + gap, 0.0);
    obstacle.waypoints.push_back({static_cast<double>(i), Eigen::Isometry3d(place)});
  }
  auto world = std::make_shared<World>();
  world->add(std::move(obstacle));
  CheckerOptions options;
  options.maxIntervals = maxIntervals;
  return {Robot::parse(kSlide, "slide.urdf"), "all", std::move(world), options};
}

constexpr std::array<double, 2> kFrom{0.0, 0.0};
constexpr std::array<double, 2> kTo{0.0, kTurns};

class MotionBudget : public testing::TestWithParam<int> {};

TEST_P(MotionBudget, CertificatesKeepToIt) {
  const Checker checker = grazing(GetParam(), 2e-7);
  Workspace workspace(checker);
  for (const MotionQuery query : {MotionQuery::VerdictOnly, MotionQuery::FirstContact}) {
    const MotionCertificate certificate = checker.certifyMotion(kFrom, kTo, workspace, query);
    EXPECT_NE(certificate.verdict, Verdict::Collision);
    EXPECT_LE(certificate.effort.intervals, GetParam());
  }
}

TEST_P(MotionBudget, ClearancesKeepToItAndStayBounds) {
  const double gap = 0.25;
  const Checker checker = grazing(GetParam(), gap);
  Workspace workspace(checker);
  const MotionClearance found = checker.motionClearance(kFrom, kTo, 1e-6, workspace);
  EXPECT_LE(found.intervals, GetParam());
  EXPECT_GE(found.intervals, 1);
  EXPECT_GE(found.lower, 0.0);
  EXPECT_LE(found.lower, gap);
  EXPECT_GE(found.upper, gap - 1e-12);
  Workspace other(checker);
  const Eigen::VectorXd q = checker.interpolate(kFrom, kTo, found.t);
  EXPECT_LE(checker.clearance({q.data(), 2}, other), found.upper + 1e-12);
}

/// A ball that slides past as many others, closer to each than the tolerance (`gap` in m).
Checker slidingPast(int others, int maxIntervals, double gap) {
  World world;
  for (int i = 0; i < others; ++i) {
    const Eigen::Translation3d place(0.0, 0.1 + gap, 2.0 * i / others - 1.0);
    world.add("ball" + std::to_string(i), makeSphere(0.05), Eigen::Isometry3d(place));
  }
  CheckerOptions options;
  options.maxIntervals = maxIntervals;
  return {Robot::parse(kSlide, "slide.urdf"), "all",
          std::make_shared<const World>(std::move(world)), options};
}

/// Each interval looked at all pairs that were open: the work was the product of the two.
TEST_P(MotionBudget, BoundsTheLooksAtPairs) {
  constexpr int kOthers = 1500;
  const Checker checker = slidingPast(kOthers, GetParam(), 2e-7);
  Workspace workspace(checker);
  for (const MotionQuery query : {MotionQuery::VerdictOnly, MotionQuery::FirstContact}) {
    const MotionCertificate certificate =
        checker.certifyMotion(std::array{-1.0}, std::array{1.0}, workspace, query);
    EXPECT_NE(certificate.verdict, Verdict::Collision);
    const Effort& effort = certificate.effort;
    EXPECT_LE(effort.distances + effort.culled, 64 * GetParam() + 2 * kOthers);
    EXPECT_LE(effort.lanes, 64 * GetParam() + 256);
  }
  const MotionClearance found =
      checker.motionClearance(std::array{-1.0}, std::array{1.0}, 1e-9, workspace);
  EXPECT_LE(found.lower, 2e-7);
  // Whatever is dropped, an interval has at least the pair that is nearest in it.
  EXPECT_LE(found.intervals, GetParam());
}

/// An obstacle that turns often: what is past the cap is not looked at, turn by turn.
TEST_P(MotionBudget, BoundsTheSubIntervalsOfAllParts) {
  const Checker checker = grazing(GetParam(), 2e-7);
  Workspace workspace(checker);
  const MotionCertificate certificate = checker.certifyMotion(kFrom, kTo, workspace);
  EXPECT_LE(certificate.effort.lanes, 64 * GetParam() + 256);
}

INSTANTIATE_TEST_SUITE_P(Caps, MotionBudget, testing::Values(1, 2, 7, 8, 10, 60, 300));

TEST(MotionBudgetOfParts, WhatIsEnoughForAllSettlesAll) {
  const Checker checker = grazing(std::numeric_limits<int>::max(), 0.25);
  Workspace workspace(checker);
  EXPECT_EQ(checker.certifyMotion(kFrom, kTo, workspace).verdict, Verdict::Free);
  const MotionClearance found = checker.motionClearance(kFrom, kTo, 1e-6, workspace);
  EXPECT_LE(found.upper - found.lower, 1e-6 + 1e-12);
  EXPECT_NEAR(found.upper, 0.25, 1e-6);
}

TEST(MotionBudgetOfParts, WhereItEndsTheRestIsUndecided) {
  const Checker checker = grazing(1, 2e-7);
  Workspace workspace(checker);
  const MotionCertificate certificate = checker.certifyMotion(kFrom, kTo, workspace);
  EXPECT_EQ(certificate.verdict, Verdict::Undecided);
  EXPECT_LT(certificate.undecidedAt, 0.5);
  EXPECT_EQ(certificate.freeUntil, certificate.undecidedAt);
}

TEST(MotionBudgetOfParts, EffortIsThatOfAllParts) {
  const Checker checker = grazing(1 << 20, 2e-7);
  Workspace workspace(checker);
  const MotionCertificate whole = checker.certifyMotion(kFrom, kTo, workspace);
  const MotionCertificate first = checker.certifyMotion(kFrom, std::array{0.0, 1.0}, workspace);
  EXPECT_GT(whole.effort.intervals, first.effort.intervals);
  EXPECT_GT(whole.effort.distances, first.effort.distances);
  EXPECT_GT(whole.effort.lanes, 10 * first.effort.lanes);
}

}  // namespace
}  // namespace swept
