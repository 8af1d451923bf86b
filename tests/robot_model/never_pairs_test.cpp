// SPDX-License-Identifier: BSD-3-Clause
// Pairs of links that never meet within the joints' limits are left out there, and nowhere else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "certify/workspace_data.hpp"
#include "version_arms.hpp"

namespace swept {
namespace {

using test::box;
using test::sphere;
using testing::HasSubstr;
using testing::Not;

/// Three joints that turn by half a radian either way, with a wall that the hand only meets beyond;
/// one more joint, `lid`, outside the group `arm`.
std::shared_ptr<const Robot> fencedArm() {
  const std::string limits = R"(<limit lower="-0.5" upper="0.5" effort="1" velocity="1"/>)";
  const std::string turn = R"(<axis xyz="0 0 1"/>)" + limits;
  const std::string out = R"(<origin xyz="0.3 0 0"/>)";
  const std::string urdf =
      "<robot name=\"fenced\">" +
      test::urdfLink("base", {{sphere(0.05), {0, 0, 0}}, {box(0.1, 0.1, 0.4), {-0.2, 0.55, 0}}}) +
      test::urdfLink("a", {{sphere(0.05), {0.15, 0, 0}}}) +
      test::urdfLink("b", {{sphere(0.05), {0.15, 0, 0}}}) +
      test::urdfLink("hand", {{box(0.2, 0.05, 0.05), {0.15, 0, 0}}}) +
      test::urdfLink("lid", {{box(0.1, 0.1, 0.1), {0.1, 0, 0.0}}}) +
      test::urdfJoint("j1", "revolute", "base", "a", turn) +
      test::urdfJoint("j2", "revolute", "a", "b", out + turn) +
      test::urdfJoint("j3", "revolute", "b", "hand", out + turn) +
      test::urdfJoint("jl", "revolute", "base", "lid", R"(<origin xyz="-0.6 0 0"/>)" + turn) +
      "</robot>";
  const std::string srdf =
      R"(<robot name="fenced"><group name="arm"><joint name="j1"/><joint name="j2"/>)"
      R"(<joint name="j3"/></group></robot>)";
  return test::parseArm(urdf, srdf);
}

Checker fenced(const CheckerOptions& options = {}) {
  return Checker(fencedArm(), "arm", std::make_shared<World>(), options);
}

constexpr std::string_view kNever = "; never: proven apart within the joints' limits";

TEST(NeverPairs, AreLeftOutWithinTheLimits) {
  const Checker checker = fenced();
  EXPECT_THAT(checker.explain("base", "hand"), HasSubstr(std::string(kNever)));
  EXPECT_THAT(checker.explain("lid", "hand"), HasSubstr(std::string(kNever)));
  Workspace workspace(checker);
  const std::vector<double> inside{0.5, 0.5, 0.5};
  EXPECT_EQ(checker.checkState(inside, workspace), Verdict::Free);
  const MotionCertificate within =
      checker.certifyMotion(std::vector<double>{-0.5, 0.0, 0.5}, inside, workspace);
  EXPECT_EQ(within.verdict, Verdict::Free);
}

TEST(NeverPairs, HoldWhereAHeldJointIsAHairBeyondItsLimit) {
  const auto robot = fencedArm();
  const auto explained = [&](double lid) {
    CheckerOptions options;
    options.reference = robot->defaultState();
    (*options.reference)[*robot->findVariable("jl")] = lid;
    return Checker(robot, "arm", std::make_shared<World>(), options).explain("base", "hand");
  };
  for (const double lid : {0.5, 0.5 + 2e-9, -0.5 - 9e-6})
    EXPECT_THAT(explained(lid), HasSubstr(std::string(kNever))) << lid;
  for (const double lid : {0.5 + 1.1e-5, -0.6})
    EXPECT_THAT(explained(lid), Not(HasSubstr(std::string(kNever)))) << lid;
}

TEST(NeverPairs, AreCheckedBeyondTheLimits) {
  const Checker checker = fenced();
  Workspace workspace(checker);
  // The hand, at 0.6 to 0.85 m, is turned into the wall.
  const std::vector<double> beyond{1.45, 0.6, 0.4};
  EXPECT_FALSE(checker.withinLimits(beyond));
  EXPECT_EQ(checker.checkState(beyond, workspace), Verdict::Collision);
  std::mt19937 random(2);
  int contacts = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> q;
    for (int k = 0; k < 3; ++k)
      q.push_back(std::uniform_real_distribution<double>(-2.5, 2.5)(random));
    const StateReport report = checker.reportState(q, workspace);
    EXPECT_EQ(checker.checkState(q, workspace), report.verdict);
    std::vector<Verdict> batch(8);
    std::vector<double> eight;
    for (int k = 0; k < 8; ++k) eight.insert(eight.end(), q.begin(), q.end());
    checker.checkStates(eight, batch, workspace);
    EXPECT_EQ(batch[3], report.verdict);
    bool withWall = false;
    for (const Witness& contact : report.contacts)
      withWall = withWall || (contact.bodyA == "base" && contact.bodyB == "hand");
    if (!withWall) continue;
    ++contacts;
    EXPECT_FALSE(checker.withinLimits(q));
    const MotionCertificate certificate =
        checker.certifyMotion(std::vector<double>{0.0, 0.0, 0.0}, q, workspace);
    EXPECT_EQ(certificate.verdict, Verdict::Collision);
  }
  EXPECT_GT(contacts, 20);
}

TEST(NeverPairs, AreThoseOfTheMarginThatWasProven) {
  const Checker checker = fenced();
  ASSERT_THAT(checker.explain("base", "hand"), HasSubstr(std::string(kNever)));
  EXPECT_THAT(checker.withRules(CollisionRules().pad("hand", 0.4)).explain("base", "hand"),
              Not(HasSubstr(std::string(kNever))));
  EXPECT_THAT(checker.withRules(CollisionRules().scale("hand", 1.01)).explain("base", "hand"),
              Not(HasSubstr(std::string(kNever))));
  const Checker padded = fenced({.margin = 0.01});
  EXPECT_THAT(padded.explain("base", "hand"), HasSubstr(std::string(kNever)));
  EXPECT_THAT(
      padded.withRules(CollisionRules().margin("base", "hand", 0.005)).explain("base", "hand"),
      HasSubstr(std::string(kNever)));
  // So near a margin that there is something to check.
  EXPECT_THAT(fenced({.margin = 0.6}).explain("base", "hand"), Not(HasSubstr(std::string(kNever))));
}

TEST(NeverPairs, AreNotProvenFromAReferenceOutsideTheLimits) {
  CheckerOptions options;
  options.reference = Eigen::VectorXd::Zero(4);
  EXPECT_THAT(fenced(options).explain("lid", "hand"), HasSubstr(std::string(kNever)));
  const int lid = *fencedArm()->findVariable("jl");
  (*options.reference)[lid] = 3.0;
  EXPECT_THAT(fenced(options).explain("lid", "hand"), Not(HasSubstr(std::string(kNever))));
}

TEST(NeverPairs, MayStillCollideIsNeverSaidOfTheRest) {
  // The arm that folds meets what stands beside its base.
  const Checker checker(test::parseArm(test::armUrdf({})), "all", std::make_shared<World>());
  EXPECT_THAT(checker.explain("base", "fore"), Not(HasSubstr(std::string(kNever))));
}

}  // namespace
}  // namespace swept
