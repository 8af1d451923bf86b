// SPDX-License-Identifier: BSD-3-Clause
// A body of the world may have the name of a link, and rules that name it are about both. Those
// were forgotten with the body: a link that had to keep 0.15 m did not have to any more, and states
// in collision became free.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "version_arms.hpp"

namespace swept {
namespace {

using test::at;
using testing::ElementsAre;
using testing::Field;

constexpr const char* kSlide = R"(<robot name="slide"><link name="base"/>
  <link name="ball"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
  <joint name="lift" type="prismatic"><parent link="base"/><child link="ball"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>)";

/// The link `ball`, 0.1 m beside `wall`, and another `ball` far away.
Checker twoBalls(CollisionRules rules) {
  auto world = std::make_shared<World>();
  world->add("wall", Sphere{0.05}, at(0.2, 0.0, 0.0));
  world->add("ball", Sphere{0.05}, at(5.0, 0.0, 0.0));
  CheckerOptions options;
  options.rules = std::move(rules);
  return {Robot::parse(kSlide, "slide.urdf"), "all", std::move(world), options};
}

Verdict verdictOf(const Checker& checker) {
  Workspace workspace(checker);
  return checker.checkState(std::vector<double>{0.0}, workspace);
}

TEST(CheckerVersionsNames, RulesAboutALinkOutliveABodyOfItsName) {
  const Checker first = twoBalls(CollisionRules().margin("ball", "wall", 0.15));
  const Checker without = first.withoutBody("ball");
  EXPECT_EQ(without.options().rules.rules().size(), 1U);
  EXPECT_EQ(verdictOf(first), Verdict::Collision);
  EXPECT_EQ(verdictOf(without), Verdict::Collision);
}

TEST(CheckerVersionsNames, RulesAboutNobodyAreForgotten) {
  const Checker first =
      twoBalls(CollisionRules().margin("ball", "wall", 0.15).pad("wall", 0.01).pad("ball", 0.01));
  EXPECT_THAT(first.withoutBody("wall").options().rules.rules(),
              ElementsAre(Field(&CollisionRules::Rule::bodyA, "ball")));
  EXPECT_THAT(first.withWorld(std::make_shared<World>()).options().rules.rules(),
              ElementsAre(Field(&CollisionRules::Rule::bodyA, "ball")));
}

}  // namespace
}  // namespace swept
