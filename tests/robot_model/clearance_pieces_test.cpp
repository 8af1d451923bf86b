// SPDX-License-Identifier: BSD-3-Clause
// A link of two pieces turns past a post. The outer piece reaches the post, so the two bodies are
// checked; the inner one ends 1 mm short of it in every configuration, so no verdict looks at it.
// Distances once did not look at it either: where the arm points at the post, 1.299 m was the
// outer piece's distance and was given as that of the bodies.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "version_arms.hpp"

namespace swept {
namespace {

using test::at;
using test::sphere;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGap = 1e-3;       // m
constexpr double kAngle = 0.1;      // rad, from the post
constexpr double kPost = 0.501;     // m, from the axis
constexpr double kInner = 0.3;      // m, from the axis
constexpr double kRadius = 0.1;     // m, of each ball
constexpr double kRounding = 1e-9;  // m, and what distances may stop at

double gapAt(double angle) {
  const double x = kPost - kInner * std::cos(angle);
  return std::hypot(x, kInner * std::sin(angle)) - 2.0 * kRadius;
}

std::shared_ptr<const Robot> robotOf(const std::vector<test::UrdfPiece>& pieces) {
  return test::parseArm("<robot name=\"r\"><link name=\"base\"/>" + test::urdfLink("arm", pieces) +
                        test::urdfJoint("j", "continuous", "base", "arm", "<axis xyz=\"0 0 1\"/>") +
                        "</robot>");
}

const test::UrdfPiece kInnerBall{sphere(kRadius), {kInner, 0, 0}};
const test::UrdfPiece kOuterBall{sphere(kRadius), {2, 0, 0}};

/// The post, and so many balls that are as far away as the arm gets.
World postAnd(int others) {
  World world;
  world.add("post", makeSphere(kRadius), at(kPost, 0, 0));
  for (int i = 0; i < others; ++i)
    world.add("ball" + std::to_string(i), makeSphere(0.01), at(-2.0 - 0.05 * i, 1.0, 0));
  return world;
}

void expectInnerPiece(const Checker& checker, const std::string& bodyA = "arm") {
  Workspace workspace(checker);
  for (const double angle : {0.0, kAngle}) {
    const std::array q{angle};
    const double gap = gapAt(angle);
    EXPECT_EQ(checker.checkState(q, workspace), Verdict::Free);
    EXPECT_NEAR(checker.clearance(q, workspace), gap, kRounding);
    const StateReport report = checker.reportState(q, workspace);
    EXPECT_NEAR(report.clearance, gap, kRounding);
    EXPECT_EQ(report.nearestA, bodyA);
    EXPECT_EQ(report.nearestB, "post");
    std::array<double, 1> gradient{};
    const SignedClearance found = checker.signedClearance(q, workspace, gradient);
    EXPECT_NEAR(found.lower, gap, kRounding);
    EXPECT_NEAR(found.upper, gap, kRounding);
    EXPECT_NEAR(gradient[0], (gapAt(angle + 1e-6) - gapAt(angle - 1e-6)) / 2e-6, 1e-5);
  }
  const std::array from{-0.5 * kAngle}, to{kAngle};
  EXPECT_EQ(checker.certifyMotion(from, to, workspace).verdict, Verdict::Free);
  const MotionClearance found = checker.motionClearance(from, to, 1e-5, workspace);
  EXPECT_LE(found.lower, kGap);
  EXPECT_GE(found.lower, kGap - 1e-5);
  EXPECT_GE(found.upper, kGap - kRounding);
  EXPECT_NEAR(found.upper, gapAt((1.5 * found.t - 0.5) * kAngle), kRounding);
}

class ClearanceOfPieces : public testing::TestWithParam<int> {};

TEST_P(ClearanceOfPieces, CountsWhatIsOutOfReach) {
  const Checker checker(robotOf({kInnerBall, kOuterBall}), "all",
                        test::shared(postAnd(GetParam())));
  EXPECT_EQ(checker.explain("arm", "post"), "arm - post: checked, keeps more than 0 m");
  expectInnerPiece(checker);
}

TEST_P(ClearanceOfPieces, CountsItInVersionsToo) {
  const Checker empty(robotOf({kInnerBall, kOuterBall}), "all", test::shared({}));
  expectInnerPiece(empty.withWorld(test::shared(postAnd(GetParam()))));
}

TEST_P(ClearanceOfPieces, CountsWhatIsAttached) {
  AttachedBody tool{.name = "tool", .link = "arm"};
  for (const double x : {kInner, 2.0}) tool.parts.push_back({makeSphere(kRadius), at(x, 0, 0)});
  CheckerOptions options;
  options.attached = {tool};
  const Checker checker(robotOf({{sphere(0.01), {0, 0, 0}}}), "all",
                        test::shared(postAnd(GetParam())), options);
  expectInnerPiece(checker, "tool");
}

/// The parts of the other body, likewise.
TEST_P(ClearanceOfPieces, CountsPartsThatAreOutOfReach) {
  World world = postAnd(GetParam());
  world.replace({.name = "post",
                 .parts = {{makeSphere(kRadius), at(kPost, 0, 0)},
                           {makeSphere(kRadius), at(0, -kInner, 0)}}});
  const Checker checker(robotOf({kInnerBall}), "all", test::shared(std::move(world)));
  expectInnerPiece(checker);
}

/// A ball less than these has boxes that are looked through, many have boxes that are sorted.
INSTANTIATE_TEST_SUITE_P(Others, ClearanceOfPieces, testing::Values(0, 40));

/// Of which no piece is in reach: such a pair is left out, and no number is about it.
TEST(ClearanceOfPairs, IsOfThoseThatAreChecked) {
  const Checker alone(robotOf({kInnerBall}), "all", test::shared(postAnd(0)));
  EXPECT_EQ(alone.explain("arm", "post"), "arm - post: not checked, out of reach");
  Workspace workspace(alone);
  const std::array q{0.0};
  EXPECT_EQ(alone.clearance(q, workspace), kInfinity);
  EXPECT_EQ(alone.signedClearance(q, workspace).lower, kInfinity);
  const MotionClearance motion = alone.motionClearance(q, q, 1e-3, workspace);
  EXPECT_EQ(motion.lower, kInfinity);
  EXPECT_EQ(motion.upper, kInfinity);
  CheckerOptions options;
  options.rules.margin("arm", "post", 2.0 * kGap);
  const Checker near(robotOf({kInnerBall}), "all", test::shared(postAnd(0)), options);
  EXPECT_NEAR(near.clearance(q, workspace), kGap, kRounding);
}

/// Nothing is attained where nothing is known.
TEST(ClearanceOfPairs, IsUnknownWhereNoPoseIs) {
  const Checker checker(robotOf({kInnerBall, kOuterBall}), "all", test::shared(postAnd(0)));
  Workspace workspace(checker);
  const std::array<double, 1> good{0.0}, nan{std::nan("")};
  const MotionClearance unknown = checker.motionClearance(good, nan, 1e-3, workspace);
  EXPECT_EQ(unknown.lower, 0.0);
  EXPECT_EQ(unknown.upper, kInfinity);
  const std::array<double, 1> least{-1.7e308}, most{1.7e308};
  const MotionClearance endless = checker.motionClearance(least, most, 1e-3, workspace);
  EXPECT_EQ(endless.lower, 0.0);
  EXPECT_EQ(endless.intervals, 1);
}

/// A follower's angle overflows; what it carries is a point on its axis, of which not even the
/// rounding is a number.
TEST(ClearanceOfPairs, IsUnknownWhereAnglesOverflow) {
  const auto robot = test::parseArm(
      "<robot name=\"r\"><link name=\"base\"/><link name=\"arm\"/><link name=\"wheel\"/>" +
      test::urdfJoint("j", "continuous", "base", "arm", "<axis xyz=\"0 0 1\"/>") +
      test::urdfJoint("k", "continuous", "arm", "wheel",
                      "<axis xyz=\"0 0 1\"/><mimic joint=\"j\" multiplier=\"100\"/>") +
      "</robot>");
  CheckerOptions options{.maxIntervals = 100};
  options.attached = {{.name = "point",
                       .link = "wheel",
                       .parts = {{makeSphere(0.0), Eigen::Isometry3d::Identity()}}}};
  options.rules.margin("point", "post", kPost);
  const Checker checker(robot, "all", test::shared(postAnd(0)), options);
  Workspace workspace(checker);
  const std::array q{1.7e308};
  EXPECT_EQ(checker.checkState(q, workspace), Verdict::Undecided);
  EXPECT_EQ(checker.clearance(q, workspace), 0.0);
  EXPECT_EQ(checker.signedClearance(q, workspace).lower, -kInfinity);
  EXPECT_EQ(checker.motionClearance(q, q, 1e-3, workspace).lower, 0.0);
}

}  // namespace
}  // namespace swept
