// SPDX-License-Identifier: BSD-3-Clause
//
// Who says whether two links are checked: rules, the SRDF, and what is so by default.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "swept/robot_model/allowed_collision_matrix.hpp"
#include "version_arms.hpp"

namespace swept {
namespace {

using test::shared;
using test::sphere;
using test::urdfJoint;
using test::urdfLink;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Balls of 0.1 m on a rail: `arm` is 1 + q from `base` and its neighbour, `tip` 0.5 beyond and
/// fixed to `arm` through a link without geometry, `cap` in the base and fixed to it.
std::shared_ptr<const Robot> rail(const std::string& srdf = {}) {
  const std::string urdf =
      R"(<robot name="rail">)" + urdfLink("base", {{sphere(0.1), {0, 0, 0}}}) +
      urdfLink("arm", {{sphere(0.1), {1, 0, 0}}}) + urdfLink("wrist", {}) +
      urdfLink("tip", {{sphere(0.1), {1.5, 0, 0}}}) + urdfLink("plate", {}) +
      urdfLink("cap", {{sphere(0.1), {0.05, 0, 0}}}) +
      urdfJoint("slide", "prismatic", "base", "arm",
                R"(<axis xyz="1 0 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/>)") +
      urdfJoint("hold", "fixed", "arm", "wrist", "") +
      urdfJoint("grip", "fixed", "wrist", "tip", "") +
      urdfJoint("on", "fixed", "base", "plate", "") +
      urdfJoint("top", "fixed", "plate", "cap", "") + "</robot>";
  const std::string text = srdf.empty() ? "" : "<robot name='rail'>" + srdf + "</robot>";
  return Robot::parse(urdf, "rail.urdf", text, text.empty() ? "" : "rail.srdf");
}

const std::string kEnable = "<enable_collisions link1='arm' link2='base'/>";

Checker checkerOf(const std::string& srdf, const CollisionRules& rules = {}) {
  return Checker(rail(srdf), "all", shared({}), {.rules = rules});
}

double clearanceAt(const Checker& checker, double q) {
  Workspace workspace(checker);
  return checker.clearance(std::span(&q, 1), workspace);
}

TEST(RuleOrder, NeighboursThatTheSrdfEnablesAreChecked) {
  const std::string others =
      "<disable_collisions link1='base' link2='tip'/><disable_collisions link1='cap' link2='arm'/>"
      "<disable_collisions link1='cap' link2='tip'/>";
  const Checker without = checkerOf(others);
  EXPECT_THAT(without.checkedPairs(), IsEmpty());
  const Checker with = checkerOf(others + kEnable);
  ASSERT_EQ(with.checkedPairs().size(), 1U);
  for (const double q : {-0.5, 0.0, 0.7})
    EXPECT_NEAR(clearanceAt(with, q), std::abs(1.0 + q) - 0.2, 1e-9);
  Workspace workspace(with);
  const double from = 0.0, to = -2.0;
  const MotionCertificate found =
      with.certifyMotion(std::span(&from, 1), std::span(&to, 1), workspace);
  EXPECT_EQ(found.verdict, Verdict::Collision);
  EXPECT_NEAR(found.freeUntil, 0.4, 1e-3);  // 1 - 2 t = 0.2
  // Where the two are said twice, they are checked, whichever comes first.
  EXPECT_EQ(checkerOf(kEnable + "<disable_collisions link1='base' link2='arm'/>" + others)
                .checkedPairs()
                .size(),
            1U);
}

TEST(RuleOrder, EachIsAboveTheNextAndExplainNamesIt) {
  const std::string disable = "<disable_collisions link1='base' link2='tip' reason='Never'/>";
  const auto said = [](const Checker& checker, const char* a, const char* b) {
    return checker.explain(a, b);
  };
  EXPECT_EQ(said(checkerOf(""), "base", "arm"), "base - arm: not checked, adjacent: joint slide");
  EXPECT_EQ(said(checkerOf(kEnable), "base", "arm"),
            "base - arm: checked (SRDF: enable_collisions), keeps more than 0 m");
  EXPECT_EQ(said(checkerOf(kEnable, CollisionRules().allow("a*", "*", "--allow")), "base", "arm"),
            "base - arm: not checked, allowed: --allow");
  EXPECT_EQ(said(checkerOf(disable), "tip", "base"), "tip - base: not checked, SRDF: Never");
  const CollisionRules scene = CollisionRules().check("tip", "base", "the scene");
  EXPECT_EQ(said(checkerOf(disable, scene), "tip", "base"),
            "tip - base: checked (the scene), keeps more than 0 m");
  EXPECT_EQ(
      said(checkerOf(disable, CollisionRules().allow("*", "*", "all").over(scene)), "tip", "base"),
      "tip - base: not checked, allowed: all");
  EXPECT_EQ(said(checkerOf(disable, CollisionRules().check("*", "*")), "arm", "base"),
            "arm - base: checked (a rule asks for it), keeps more than 0 m");
  EXPECT_EQ(said(checkerOf(""), "base", "tip"), "base - tip: checked, keeps more than 0 m");
}

/// What is rigid is looked at once, and does not become silent by being asked for.
TEST(RuleOrder, LinksThatCannotMoveAreStandingContactsWhenTheyAreEnabled) {
  const auto standing = [](const Checker& checker) {
    std::vector<std::string> pairs;
    for (const Checker::Pair& pair : checker.staticContacts())
      pairs.push_back(pair.bodyA + " " + pair.bodyB);
    return pairs;
  };
  const std::string disable = "<disable_collisions link1='base' link2='cap'/>";
  EXPECT_THAT(standing(checkerOf(disable)), IsEmpty());
  EXPECT_THAT(standing(checkerOf(disable + "<enable_collisions link1='cap' link2='base'/>")),
              ElementsAre("base cap"));
  EXPECT_THAT(standing(checkerOf(disable, CollisionRules().check("cap", "base"))),
              ElementsAre("base cap"));
}

TEST(RuleOrder, ALinkThatIsOffByDefaultIsCheckedAgainstTheWorldAndWhatIsEnabled) {
  World world;
  world.add(WorldBody{.name = "wall", .parts = {{Sphere{0.1}, test::at(4, 0, 0)}}});
  const Checker checker(rail("<disable_default_collisions link='tip'/>"
                             "<enable_collisions link1='tip' link2='cap'/>"),
                        "all", shared(world));
  EXPECT_THAT(checker.explain("tip", "base"), HasSubstr("SRDF: disable_default_collisions"));
  EXPECT_THAT(checker.explain("tip", "cap"), HasSubstr("checked (SRDF: enable_collisions)"));
  EXPECT_THAT(checker.explain("tip", "wall"), HasSubstr(": checked,"));
}

/// `arm` is in `base` and `cap` at the default state, and no joint connects it to either: in `base`
/// it always is, and it leaves `cap` when it turns.
TEST(RuleOrder, ContactsThatAreAlwaysThereAreAllowedForWhoeverAsks) {
  const std::string turn =
      R"(<axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/>)";
  const auto robot =
      Robot::parse(R"(<robot name="r">)" + urdfLink("base", {{sphere(0.1), {0, 0, 0}}}) +
                       urdfLink("flange", {}) + urdfLink("arm", {{sphere(0.1), {0.15, 0, 0}}}) +
                       urdfLink("pin", {}) + urdfLink("tip", {{sphere(0.1), {0.4, 0, 0}}}) +
                       urdfLink("cap", {{sphere(0.1), {0.1, 0, 0}}}) +
                       urdfJoint("f", "fixed", "base", "flange", "") +
                       urdfJoint("g", "fixed", "flange", "cap", "") +
                       urdfJoint("a", "revolute", "flange", "arm", turn) +
                       urdfJoint("p", "fixed", "arm", "pin", "") +
                       urdfJoint("b", "revolute", "pin", "tip", turn) + "</robot>",
                   "r.urdf");
  const DefaultContacts contacts = defaultContacts(*robot);
  // base and cap are in contact, too, but rigid: a standing contact.
  ASSERT_EQ(contacts.always.rules().size(), 1U);
  EXPECT_TRUE(contacts.always.allowed("base", "arm").value());
  EXPECT_EQ(contacts.always.rules()[0].reason, kDefaultContact);
  EXPECT_EQ(contacts.sometimes, (std::vector<std::pair<std::string, std::string>>{{"cap", "arm"}}));
  const Checker all(robot, "all", shared({}));
  const Checker less(robot, "all", shared({}), {.rules = contacts.always});
  const Checker kept(robot, "all", shared({}),
                     {.rules = CollisionRules().check("base", "arm").over(contacts.always)});
  // Where the arm has left the cap.
  const std::vector<double> turned{2.5, 0.0};
  for (const auto& [checker, verdict] :
       {std::pair{&all, Verdict::Collision}, {&less, Verdict::Free}, {&kept, Verdict::Collision}}) {
    Workspace workspace(*checker);
    EXPECT_EQ(checker->checkState(turned, workspace), verdict);
  }
  Workspace workspace(less);
  EXPECT_EQ(less.checkState(std::vector<double>{0.0, 0.0}, workspace), Verdict::Collision);
  EXPECT_EQ(less.explain("base", "arm"),
            "base - arm: not checked, allowed: in contact at the "
            "default state and at all others that were looked at");
  EXPECT_EQ(less.staticContacts().size(), 1U);
}

}  // namespace
}  // namespace swept
