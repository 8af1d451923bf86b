// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/collision_rules.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "version_arms.hpp"

namespace swept {
namespace {

using test::agreementOf;
using test::armSrdf;
using test::armUrdf;
using test::messageOf;
using test::parseArm;
using test::shared;

TEST(CollisionRules, ThePatternAddedLastCounts) {
  CollisionRules rules;
  rules.allow("*", "table").check("hand", "*").allow("left_*_tip", "ta*e", "it may lean on it");
  EXPECT_TRUE(rules.allowed("arm", "table").value());
  EXPECT_TRUE(rules.allowed("table", "arm").value());
  EXPECT_FALSE(rules.allowed("hand", "table").value());
  EXPECT_FALSE(rules.allowed("table", "hand").value());
  EXPECT_TRUE(rules.allowed("left_finger_tip", "table").value());
  EXPECT_TRUE(rules.allowed("table", "left__tip").value());
  EXPECT_FALSE(rules.allowed("left_tip", "shelf").has_value());
  EXPECT_FALSE(rules.allowed("arm", "shelf").has_value());
  EXPECT_EQ(rules.find(CollisionRules::Kind::Allow, "left_finger_tip", "table")->reason,
            "it may lean on it");
}

TEST(CollisionRules, APatternMatchesWhatItSays) {
  const auto matches = [](const std::string& pattern, const std::string& name) {
    return CollisionRules().pad(pattern, 1.0).padding(name) == 1.0;
  };
  for (const char* pattern : {"*", "**", "a*", "*c", "a*c", "*b*", "abc", "*a*b*c*", "a**c"})
    EXPECT_TRUE(matches(pattern, "abc")) << pattern;
  for (const char* pattern : {"b*", "*b", "ab", "abcd", "a*d", "*ac*", "ABC", "abc?"})
    EXPECT_FALSE(matches(pattern, "abc")) << pattern;
  EXPECT_TRUE(matches("a*b*c", "a_b_b_c_c"));
  EXPECT_FALSE(matches("a*b*c", "a_b_b_c_d"));
  EXPECT_TRUE(matches("*", ""));
}

TEST(CollisionRules, PaddingsAndScalesAreOfOneBody) {
  CollisionRules rules;
  rules.pad("*", 0.01).pad("hand", 0.02).scale("fore*", 1.5);
  EXPECT_EQ(rules.padding("hand"), 0.02);
  EXPECT_EQ(rules.padding("table"), 0.01);
  EXPECT_EQ(rules.scale("forearm"), 1.5);
  EXPECT_EQ(rules.scale("hand"), 1.0);
  // A rule about a body says nothing about pairs, nor the other way round.
  EXPECT_FALSE(rules.allowed("hand", "table").has_value());
  EXPECT_EQ(CollisionRules().margin("hand", "*", 0.3).padding("hand"), 0.0);
  EXPECT_TRUE(CollisionRules().empty());
  EXPECT_FALSE(rules.empty());
}

TEST(CollisionRules, WithoutABodyItsOwnRulesAreGone) {
  CollisionRules rules;
  rules.allow("hand", "cup").pad("cup", 0.01).pad("c*", 0.02).allow("*", "table");
  const CollisionRules left = rules.without("cup");
  ASSERT_EQ(left.rules().size(), 2U);
  EXPECT_EQ(left.padding("cup"), 0.02);
  EXPECT_FALSE(left.allowed("hand", "cup").has_value());
  EXPECT_EQ(rules.rules().size(), 4U);
}

/// The paddings of all bodies were gone with one whose name was that of a pattern.
TEST(CollisionRules, APatternIsNoBodysOwn) {
  CollisionRules rules;
  rules.pad("*", 0.01).pad("c*", 0.02);
  EXPECT_EQ(rules.without("*").padding("hand"), 0.01);
  EXPECT_EQ(rules.without("c*").padding("cup"), 0.02);
}

TEST(CollisionRules, ImpossibleValuesAreErrors) {
  CollisionRules rules;
  EXPECT_EQ(messageOf([&] { rules.pad("hand", -1e-9); }),
            "CollisionRules: the padding of 'hand', -1e-09 m, must be a finite number that is not "
            "negative");
  EXPECT_EQ(messageOf([&] { rules.margin("a", "b", std::nan("")); }),
            "CollisionRules: the margin of 'a' and 'b', nan m, must be a finite number that is not "
            "negative");
  EXPECT_EQ(messageOf([&] { rules.scale("hand", 0.0); }),
            "CollisionRules: the scale of 'hand', 0, must be a finite number above zero");
  EXPECT_EQ(messageOf([&] { rules.scale("hand", HUGE_VAL); }),
            "CollisionRules: the scale of 'hand', inf, must be a finite number above zero");
  EXPECT_EQ(messageOf([&] { rules.allow("hand", ""); }),
            "CollisionRules: a body's name must not be empty");
  EXPECT_TRUE(rules.empty());
}

TEST(CollisionRules, ARuleAboutABodyThatIsNotThereIsAnError) {
  const auto robot = parseArm(armUrdf({}));
  const auto world = shared(test::clutter(1));
  const auto make = [&](const CollisionRules& rules) {
    return messageOf([&] { Checker(robot, "all", world, {.rules = rules}); });
  };
  EXPECT_EQ(make(CollisionRules().pad("hnad", 0.01)),
            "Checker: a rule names 'hnad', which is no link, attached body or body of the world");
  EXPECT_EQ(make(CollisionRules().allow("hand", "cup")),
            "Checker: a rule names 'cup', which is no link, attached body or body of the world");
  EXPECT_EQ(make(CollisionRules().allow("hand", "body1").pad("c*", 0.1)), "");
}

TEST(CollisionRules, AllowIsWhatAnSrdfDisables) {
  const std::string urdf = armUrdf({});
  const auto world = shared({});
  const auto plain = parseArm(urdf);
  const auto disabling = parseArm(urdf, armSrdf({{"base", "hand"}, {"base", "fore"}}));
  const Checker bySrdf(disabling, "all", world);
  const Checker same(plain, "all", world, {.rules = CollisionRules().allow("base", "*")});
  const test::Agreement agreement = agreementOf(same, bySrdf, 400, 1);
  EXPECT_EQ(agreement.differing, 0);
  EXPECT_GT(agreement.free, 600);
  // The rule takes away contacts that there are.
  const Checker all(plain, "all", world);
  EXPECT_GT(agreementOf(all, same, 400, 1).differing, 50);
}

TEST(CollisionRules, CheckOverridesTheSrdf) {
  const std::string urdf = armUrdf({});
  const auto world = shared({});
  const Checker all(parseArm(urdf), "all", world);
  const Checker again(parseArm(urdf, armSrdf({{"base", "hand"}, {"base", "fore"}})), "all", world,
                      {.rules = CollisionRules().check("base", "hand").check("fore", "base")});
  agreementOf(all, again, 1000, 2).expectRepresentative(100);
}

TEST(CollisionRules, AnAllowedWorldBodyIsAsGoodAsGone) {
  const auto robot = parseArm(armUrdf({}));
  const World full = test::clutter(12);
  World less = full;
  CollisionRules rules = CollisionRules().allow("body4", "*", "a curtain");
  EXPECT_TRUE(less.remove("body4"));
  EXPECT_FALSE(less.remove("body4"));
  for (const char* name : {"body0", "body1", "body2", "body5", "body7"}) {
    rules.allow("*", name);
    EXPECT_TRUE(less.remove(name));
  }
  const Checker allowing(robot, "all", shared(full), {.rules = rules});
  const Checker without(robot, "all", shared(less));
  agreementOf(allowing, without, 600, 3).expectRepresentative(100);
  EXPECT_GT(agreementOf(Checker(robot, "all", shared(full)), without, 600, 3).differing, 20);
}

}  // namespace
}  // namespace swept
