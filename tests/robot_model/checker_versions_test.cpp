// SPDX-License-Identifier: BSD-3-Clause
// Versions of a checker, each against one that was made from nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "version_arms.hpp"

namespace swept {
namespace {

using test::agreementOf;
using test::armUrdf;
using test::at;
using test::messageOf;
using test::parseArm;
using test::shared;

WorldBody ball(const std::string& name, double x, double y, double z, double radius = 0.1) {
  return {.name = name, .parts = {{Sphere{radius}, at(x, y, z)}}};
}

std::vector<Verdict> verdictsOf(const Checker& checker, unsigned seed) {
  std::mt19937 random(seed);
  Workspace workspace(checker);
  std::vector<Verdict> verdicts;
  for (int i = 0; i < 100; ++i) {
    const std::vector<double> from = test::randomConfiguration(checker, random);
    const std::vector<double> to = test::randomConfiguration(checker, random);
    verdicts.push_back(checker.certifyMotion(from, to, workspace).verdict);
    verdicts.push_back(checker.checkState(to, workspace));
  }
  return verdicts;
}

TEST(CheckerVersions, BodiesComeAndGo) {
  const auto robot = parseArm(armUrdf({}));
  World world = test::clutter(21);
  const Checker first(robot, "all", shared(world));
  const std::vector<Verdict> before = verdictsOf(first, 1);
  const Checker more = first.withBody(ball("ball", 0.3, 0.3, 0.5));
  const Checker less = more.withoutBody("body1");
  world.add(ball("ball", 0.3, 0.3, 0.5));
  EXPECT_EQ(verdictsOf(more, 1), verdictsOf(Checker(robot, "all", shared(world)), 1));
  EXPECT_TRUE(world.remove("body1"));
  EXPECT_EQ(verdictsOf(less, 1), verdictsOf(Checker(robot, "all", shared(world)), 1));
  EXPECT_NE(verdictsOf(less, 1), before);
  // Whoever has the first one still has it.
  EXPECT_EQ(verdictsOf(first, 1), before);
  EXPECT_EQ(messageOf([&] { (void)less.withoutBody("body1"); }),
            "Checker: there is no body of the world 'body1'");
  EXPECT_EQ(messageOf([&] { (void)less.withBody(ball("ball", 0, 0, 1)); }),
            "World: a second body is named 'ball'");
}

TEST(CheckerVersions, OneWorkspaceServesAll) {
  const auto robot = parseArm(armUrdf({}));
  const Checker first(robot, "all", shared(test::clutter(22)));
  const Checker second = first.withoutBody("body0").withBody(ball("ball", 0.2, 0.2, 0.6));
  const Checker third(parseArm(armUrdf({}), test::armSrdf({{"hand", "base"}})), "all",
                      shared(test::clutter(23, 40)));
  Workspace workspace(first);
  std::mt19937 random(2);
  test::Agreement agreement;
  for (int i = 0; i < 300; ++i) {
    const Checker& checker = i % 3 == 0 ? first : i % 3 == 1 ? second : third;
    const std::vector<double> from = test::randomConfiguration(checker, random);
    const std::vector<double> to = test::randomConfiguration(checker, random);
    Workspace own(checker);
    const MotionCertificate shared = checker.certifyMotion(from, to, workspace);
    const MotionCertificate fresh = checker.certifyMotion(from, to, own);
    EXPECT_EQ(shared.verdict, fresh.verdict);
    test::compare(shared.verdict, fresh.verdict, agreement);
    EXPECT_EQ(shared.freeUntil, fresh.freeUntil);
    EXPECT_EQ(checker.clearance(to, workspace), checker.clearance(to, own));
  }
  agreement.expectRepresentative(40);
}

TEST(CheckerVersions, RulesDieWithTheBodyTheyName) {
  const auto robot = parseArm(armUrdf({}));
  const Checker first(robot, "all", shared(test::clutter(24)));
  const Checker allowing = first.withBody(ball("cup", 0.0, 0.3, 0.5))
                               .withRules(CollisionRules().allow("hand", "cup").pad("*", 0.01));
  EXPECT_EQ(allowing.explain("hand", "cup"), "hand - cup: not checked, allowed");
  // The cup that comes later is another one.
  const Checker later = allowing.withoutBody("cup").withBody(ball("cup", 0.0, 0.3, 0.5));
  EXPECT_EQ(later.explain("hand", "cup"),
            "hand - cup: checked, keeps more than 0.02 m (margin 0 m, padding of hand 0.01 m, "
            "padding of cup 0.01 m)");
  EXPECT_EQ(later.options().rules.rules().size(), 1U);
  // One that only moves is the same.
  World moved = allowing.world();
  moved.remove("cup");
  moved.add(ball("cup", 0.1, 0.3, 0.5));
  EXPECT_EQ(allowing.withWorld(shared(moved)).explain("hand", "cup"),
            "hand - cup: not checked, allowed");
  // And of attached bodies.
  AttachedBody tool{.name = "tool", .link = "hand", .parts = {{Sphere{0.05}, at(0, 0, 0.1)}}};
  const Checker held = first.withAttached(tool).withRules(CollisionRules().allow("tool", "*"));
  EXPECT_TRUE(held.withoutAttached("tool").options().rules.empty());
}

/// The same shape, and so the same cover: what was known of the body holds for its place alone.
TEST(CheckerVersions, AnAttachedBodyIsLookedAtWhereItIs) {
  const auto robot = parseArm(armUrdf({}));
  const auto world = shared({});
  const Shape rod = makeCapsule(0.02, 0.1);
  Checker version = Checker(robot, "all", world).withAttached("rod", "hand", rod, at(0, 0, 0.1));
  unsigned seed = 40;
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(0.15, 0, 0.1), Eigen::Vector3d(-0.1, 0, 0.2), Eigen::Vector3d(0, 0, 0.1)}) {
    const Eigen::Isometry3d hand_from_rod(Eigen::Translation3d{place});
    version = version.withoutAttached("rod").withAttached("rod", "hand", rod, hand_from_rod);
    const Checker made =
        Checker(robot, "all", world).withAttached("rod", "hand", rod, hand_from_rod);
    agreementOf(version, made, 300, ++seed).expectRepresentative(20);
    EXPECT_EQ(verdictsOf(version, seed), verdictsOf(made, seed));
  }
}

TEST(CheckerVersions, ChangedRulesAreThoseOfACheckerMadeWithThem) {
  const auto robot = parseArm(armUrdf({}));
  const auto world = shared(test::clutter(25));
  const Checker plain(robot, "all", world);
  const std::vector<CollisionRules> several{
      CollisionRules().pad("hand", 0.05), CollisionRules().allow("hand", "base"),
      CollisionRules().scale("fore", 1.3).pad("body*", 0.02),
      CollisionRules().margin("hand", "base", 0.1).allow("upper", "*"), CollisionRules()};
  Checker version = plain;
  unsigned seed = 30;
  for (const CollisionRules& rules : several) {
    version = version.withRules(rules);
    agreementOf(version, Checker(robot, "all", world, {.rules = rules}), 300, ++seed)
        .expectRepresentative(40);
  }
  EXPECT_EQ(verdictsOf(version, 3), verdictsOf(plain, 3));
}

TEST(CheckerVersions, AMeshInTheWorldIsShared) {
  std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}};
  const std::vector<TriangleMesh::Triangle> faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  World world = test::clutter(26);
  world.add("mesh", TriangleMesh::build(corners, faces), at(0.2, -0.4, 0.4));
  const auto robot = parseArm(armUrdf({}));
  const Checker first(robot, "all", shared(world));
  const Checker second = first.withBody(ball("ball", 0.2, 0.4, 0.5));
  world.add(ball("ball", 0.2, 0.4, 0.5));
  EXPECT_EQ(verdictsOf(second, 4), verdictsOf(Checker(robot, "all", shared(world)), 4));
}

TEST(CheckerVersions, BodiesWithoutGeometryChangeNothing) {
  const auto robot = parseArm(armUrdf({}));
  const Checker first(robot, "all", shared(test::clutter(28)));
  const Checker held = first.withAttached({.name = "nothing", .link = "hand"});
  EXPECT_EQ(verdictsOf(held, 5), verdictsOf(first, 5));
  EXPECT_EQ(verdictsOf(held.withoutAttached("nothing"), 5), verdictsOf(first, 5));
  MovingObstacle ghost{.name = "ghost"};
  ghost.waypoints.push_back({0.0, at(0.0, 0.0, 1.0)});
  const Checker haunted = held.withObstacle(ghost);
  ASSERT_EQ(haunted.dimension(), 3);
  Workspace workspace(haunted);
  Workspace own(first);
  std::mt19937 random(6);
  for (int i = 0; i < 200; ++i) {
    const std::vector<double> q = test::randomConfiguration(first, random);
    const std::vector<double> timed{q[0], q[1], 0.5};
    EXPECT_EQ(haunted.checkState(timed, workspace), first.checkState(q, own));
  }
}

TEST(CheckerVersions, ExplainsEveryPairOfNames) {
  const auto robot = parseArm(armUrdf({}), test::armSrdf({{"base", "fore"}}));
  World world = test::clutter(27);
  world.add(ball("moon", 30.0, 0.0, 0.0));
  const Checker checker(robot, "all", shared(world),
                        {.rules = CollisionRules().allow("hand", "body0", "a curtain")});
  EXPECT_EQ(checker.explain("hand", "body0"), "hand - body0: not checked, allowed: a curtain");
  EXPECT_EQ(checker.explain("fore", "base"), "fore - base: not checked, SRDF: test");
  EXPECT_EQ(checker.explain("upper", "fore"), "upper - fore: not checked, adjacent: joint elbow");
  EXPECT_EQ(checker.explain("base", "body1"), "base - body1: not checked, not moved by the group");
  EXPECT_EQ(checker.explain("moon", "hand"), "moon - hand: not checked, out of reach");
  EXPECT_EQ(checker.explain("body1", "moon"),
            "body1 - moon: not checked, both belong to the world");
  EXPECT_EQ(checker.explain("hand", "hand"), "hand - hand: not checked, one body");
  EXPECT_EQ(checker.explain("hand", "body1"), "hand - body1: checked, keeps more than 0 m");
  EXPECT_EQ(checker.explain("hand", "base"),
            "hand - base: checked, keeps more than 0 m; never: proven apart within the joints' "
            "limits");
  EXPECT_EQ(messageOf([&] { (void)checker.explain("hand", "sun"); }),
            "Checker: 'sun' is no link, attached body or body of the world");
}

}  // namespace
}  // namespace swept
