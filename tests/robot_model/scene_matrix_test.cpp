// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "scene_summary.hpp"
#include "swept/robot_model/planning_scene.hpp"

namespace swept {
namespace {

using ::testing::EndsWith;

const std::string kWorld =
    "collision_objects:\n  - {id: post, primitives: [{type: sphere, dimensions: [0.1]}]}\n";

/// A chain, in which a joint connects each to the next; the SRDF disables none.
std::shared_ptr<const Robot> chain() {
  std::string text = "<robot name='chain'><link name='root'/>";
  std::string parent = "root";
  for (const std::string name : {"a", "b", "c"}) {
    text += "<link name='" + name +
            "'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>"
            "<joint name='j" +
            name + "' type='prismatic'><parent link='" + parent + "'/><child link='" + name +
            "'/><axis xyz='1 0 0'/><limit lower='-5' upper='5' effort='1' velocity='1'/></joint>";
    parent = name;
  }
  return Robot::parse(text + "</robot>", "chain.urdf");
}

std::string matrix(const std::string& text) {
  return "allowed_collision_matrix: {" + text + "}\n";
}

/// What Checker::explain says of a pair, without the pair and the reasons.
std::string fate(const Checker& checker, const std::string& a, const std::string& b) {
  const std::string text = checker.explain(a, b);
  const std::size_t colon = text.find(": ");
  const std::string fate = text.substr(colon + 2, text.find(',') - colon - 2);
  return fate.substr(0, fate.find(" ("));
}

Checker checkerOf(const std::shared_ptr<const Robot>& robot, const std::string& scene,
                  const CheckerOptions& own = {}) {
  const test::TemporaryFolder folder;
  const PlanningScene read = PlanningScene::load(folder.write("s.yaml", scene), *robot);
  return {robot, robot->groups().front().name, std::make_shared<const World>(read.world),
          read.checkerOptions(own)};
}

/// A dump of MoveIt's takes back what the SRDF disables.
TEST(SceneMatrix, StandsInPlaceOfTheSrdf) {
  const auto robot = test::twoArms();
  EXPECT_EQ(fate(checkerOf(robot, kWorld), "l", "r"), "not checked");
  const std::string off =
      matrix("entry_names: [l, r], entry_values: [[false, false], [false, false]]");
  EXPECT_EQ(fate(checkerOf(robot, kWorld + off), "l", "r"), "checked");
  const std::string other = matrix("entry_names: [post], entry_values: [[false]]");
  EXPECT_EQ(fate(checkerOf(robot, kWorld + other), "l", "r"), "checked") << "it is not allowed";
  const std::string on =
      matrix("entry_names: [l, r], entry_values: [[false, true], [true, false]]");
  EXPECT_EQ(fate(checkerOf(robot, kWorld + on), "l", "r"), "not checked");
  const std::string none = matrix("entry_names: [], entry_values: []");
  EXPECT_EQ(fate(checkerOf(robot, kWorld + none), "l", "r"), "not checked") << "it says nothing";
}

/// In MoveIt nothing but the matrix knows of neighbours.
TEST(SceneMatrix, NeighboursAreCheckedUnlessItAllowsThem) {
  const std::string text = kWorld + matrix("entry_names: [a, b], entry_values: [[0, 1], [1, 0]]");
  const Checker checker = checkerOf(chain(), text);
  EXPECT_EQ(fate(checker, "a", "b"), "not checked");
  EXPECT_EQ(fate(checker, "b", "c"), "checked");
  EXPECT_EQ(fate(checker, "a", "c"), "checked");
  Workspace workspace(checker);
  EXPECT_EQ(checker.checkState(std::vector{1.0, 0.0, 0.0}, workspace), Verdict::Collision);
  EXPECT_EQ(checker.checkState(std::vector{1.0, 0.0, 1.0}, workspace), Verdict::Free);
}

TEST(SceneMatrix, EntriesCountBeforeDefaultsAndDefaultsThatCheckBeforeThoseThatAllow) {
  const Checker checker = checkerOf(
      chain(), kWorld + matrix("entry_names: [a, post], entry_values: [[0, 0], [0, 0]], "
                               "default_entry_names: [a, b, c], default_entry_values: [true, "
                               "true, false]"));
  EXPECT_EQ(fate(checker, "a", "post"), "checked") << "an entry";
  EXPECT_EQ(fate(checker, "a", "b"), "not checked") << "both defaults allow";
  EXPECT_EQ(fate(checker, "a", "c"), "checked") << "one of them does not";
  EXPECT_EQ(fate(checker, "b", "post"), "not checked") << "one default alone";
}

TEST(SceneMatrix, SpeaksOfObjectsThatMove) {
  const std::string cart =
      "world: {collision_objects: [{id: cart, primitives: [{type: sphere, dimensions: [0.1]}], "
      "motion: [{time: 0, position: [0, 0, 9]}]}]}\n";
  const auto robot = test::twoArms();
  const auto with = [&](const std::string& value) {
    return checkerOf(robot, cart + matrix("entry_names: [l, cart], entry_values: [[0, " + value +
                                          "], [" + value + ", 0]]"));
  };
  EXPECT_EQ(fate(with("true"), "l", "cart"), "not checked");
  EXPECT_EQ(fate(with("false"), "l", "cart"), "checked");
}

TEST(SceneMatrix, TouchLinksTouchWhateverItSays) {
  const std::string attached =
      "robot_state:\n  attached_collision_objects:\n"
      "    - {link_name: l, object: {id: rod, header: {frame_id: l}, primitives: [{type: sphere, "
      "dimensions: [0.1]}]}, touch_links: [r, cap, ghost]}\n"
      "    - {link_name: r, object: {id: cap, header: {frame_id: r}, primitives: [{type: sphere, "
      "dimensions: [0.1]}]}}\n";
  const std::string names = matrix(
      "entry_names: [rod, r, cap, l], entry_values: [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, "
      "0], [0, 0, 0, 0]]");
  const Checker checker = checkerOf(test::twoArms(), kWorld + attached + names);
  EXPECT_EQ(fate(checker, "rod", "r"), "not checked");
  EXPECT_EQ(fate(checker, "rod", "cap"), "not checked");
  EXPECT_EQ(fate(checker, "cap", "l"), "checked");
  EXPECT_EQ(fate(checker, "rod", "post"), "checked");
}

TEST(SceneMatrix, ASceneSaysWhetherItHasOne) {
  const test::TemporaryFolder folder;
  const auto has = [&](const std::string& text) {
    return PlanningScene::load(folder.write("s.yaml", kWorld + text), *chain()).hasMatrix;
  };
  EXPECT_FALSE(has(""));
  EXPECT_FALSE(has(matrix("entry_names: [], entry_values: []")));
  EXPECT_TRUE(has(matrix("entry_names: [a], entry_values: [[true]]")));
  EXPECT_TRUE(has(matrix("default_entry_names: [a], default_entry_values: [true]")));
}

TEST(SceneMatrix, TheProgramsRulesCountBeforeIt) {
  CheckerOptions own;
  own.rules.allow("l", "r").check("l", "post");
  const std::string text =
      kWorld + matrix("entry_names: [l, r, post], entry_values: [[0, 0, 1], [0, 0, 1], [1, 1, 0]]");
  const Checker checker = checkerOf(test::twoArms(), text, own);
  EXPECT_EQ(fate(checker, "l", "r"), "not checked");
  EXPECT_EQ(fate(checker, "l", "post"), "checked");
  EXPECT_EQ(fate(checkerOf(test::twoArms(), text), "l", "post"), "not checked");
}

TEST(SceneMatrix, WhatIsNoMatrixIsRefused) {
  const auto refusal = [](const std::string& text) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("s.yaml", kWorld + matrix(text));
    return test::inputError([&] { PlanningScene::load(file, *chain()); });
  };
  EXPECT_THAT(refusal("entry_names: [a, b], entry_values: [[1, 1]]"),
              EndsWith("s.yaml:3: error: allowed_collision_matrix.entry_values has 1 entries for 2 "
                       "entry_names"));
  EXPECT_THAT(refusal("entry_names: [a], entry_values: [{enabled: [1, 1]}]"),
              EndsWith("entry_values[0].enabled has 2 entries for 1 entry_names"));
  EXPECT_THAT(refusal("entry_names: [a, a], entry_values: [[1, 1], [1, 1]]"),
              EndsWith("entry_names[1] is 'a' a second time"));
  EXPECT_THAT(refusal("entry_names: [a, b], entry_values: [[1, 1], [0, 1]]"),
              EndsWith("entry_values[1][0] is 0 and the other way round is not: 'b' and 'a'"));
  EXPECT_THAT(refusal("entry_names: [a], entry_values: [[maybe]]"),
              EndsWith("entry_values[0][0] is 'maybe'; allowed are true and false"));
  EXPECT_THAT(refusal("default_entry_names: [a], default_entry_values: []"),
              EndsWith("default_entry_values has 0 entries for 1 default_entry_names"));
  EXPECT_THAT(refusal("default_entry_names: [a], default_entry_values: [true]}\nis_diff: true\n"
                      "robot_state: {"),
              EndsWith("has default_entry_names and no entry_names, which a diff does not apply"));
}

}  // namespace
}  // namespace swept
