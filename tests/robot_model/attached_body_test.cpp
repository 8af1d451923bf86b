// SPDX-License-Identifier: BSD-3-Clause
// A robot with a body attached is one with a link more, on a fixed joint.
#include "swept/robot_model/attached_body.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "version_arms.hpp"

namespace swept {
namespace {

using test::agreementOf;
using test::armSrdf;
using test::armUrdf;
using test::at;
using test::box;
using test::messageOf;
using test::parseArm;
using test::shared;
using test::sphere;

AttachedBody tool(const std::string& name = "tool") {
  AttachedBody body{.name = name, .link = "hand"};
  body.parts.push_back({Box{{0.02, 0.1, 0.03}}, at(0.0, 0.1, 0.05)});
  body.parts.push_back({Sphere{0.04}, at(0.2, 0.0, -0.1)});
  return body;
}

/// The same as a link; adjacent to the hand.
std::string toolAsLink() {
  return test::urdfLink("tool",
                        {{box(0.04, 0.2, 0.06), {0, 0.1, 0.05}}, {sphere(0.04), {0.2, 0, -0.1}}}) +
         test::urdfJoint("grasp", "fixed", "hand", "tool", "");
}

TEST(AttachedBody, IsCheckedAgainstTheWorldAndTheRobot) {
  const auto world = shared(test::clutter(11));
  const auto plain = parseArm(armUrdf({}));
  const Checker attached(plain, "all", world, {.attached = {tool()}});
  const Checker linked(parseArm(armUrdf({}, toolAsLink())), "all", world);
  agreementOf(attached, linked, 600, 1).expectRepresentative(100);
  EXPECT_GT(agreementOf(attached, Checker(plain, "all", world), 600, 1).differing, 10);
}

TEST(AttachedBody, IsNotCheckedAgainstTouchLinks) {
  const auto world = shared({});
  const auto plain = parseArm(armUrdf({}));
  AttachedBody body = tool();
  body.touchLinks = {"upper"};
  const Checker attached(plain, "all", world, {.attached = {body}});
  const auto linked = parseArm(armUrdf({}, toolAsLink()), armSrdf({{"tool", "upper"}}));
  agreementOf(attached, Checker(linked, "all", world), 600, 2).expectRepresentative(60);
  const Checker strict(plain, "all", world, {.attached = {tool()}});
  EXPECT_GT(agreementOf(attached, strict, 600, 2).differing, 10);
  EXPECT_EQ(attached.explain("tool", "upper"), "tool - upper: not checked, touch link of tool");
  EXPECT_EQ(attached.explain("hand", "tool"), "hand - tool: not checked, attached to hand");
  EXPECT_EQ(attached.explain("base", "tool"), "base - tool: checked, keeps more than 0 m");
}

TEST(AttachedBody, TouchLinksMayBePatterns) {
  const auto world = shared({});
  const auto plain = parseArm(armUrdf({}));
  AttachedBody named = tool(), pattern = tool();
  named.touchLinks = {"base", "upper"};
  pattern.touchLinks = {"b*e", "*pp*", "finger_*"};  // the last is that of no link
  const Checker byName(plain, "all", world, {.attached = {named}});
  const Checker byPattern(plain, "all", world, {.attached = {pattern}});
  const std::string reason = "not checked, touch link of tool";
  for (const std::string link : {"base", "upper"}) {
    EXPECT_EQ(byName.explain("tool", link), "tool - " + link + ": " + reason);
    EXPECT_EQ(byPattern.explain("tool", link), "tool - " + link + ": " + reason);
  }
  EXPECT_EQ(byPattern.explain("hand", "tool"), "hand - tool: not checked, attached to hand");
  EXPECT_EQ(byPattern.checkedPairs().size(), byName.checkedPairs().size());
  EXPECT_GT(Checker(plain, "all", world, {.attached = {tool()}}).checkedPairs().size(),
            byName.checkedPairs().size());
}

TEST(AttachedBody, AVersionWithItIsLikeACheckerMadeWithIt) {
  const auto world = shared(test::clutter(12));
  const auto plain = parseArm(armUrdf({}));
  const Checker empty(plain, "all", world);
  const Checker one = empty.withAttached(tool());
  const Checker two = one.withAttached(tool("second"));
  agreementOf(one, Checker(plain, "all", world, {.attached = {tool()}}), 400, 3)
      .expectRepresentative(60);
  // Two bodies on one hand do not move against each other.
  EXPECT_THAT(two.explain("tool", "second"), testing::HasSubstr("not checked, rigid"));
  EXPECT_THAT(two.explain("tool", "second"), testing::HasSubstr("in contact"));
  agreementOf(one, two, 400, 3).expectRepresentative(60);
  const Checker back = two.withoutAttached("tool").withoutAttached("second");
  agreementOf(empty, back, 400, 3).expectRepresentative(60);
  EXPECT_TRUE(back.options().attached.empty());
  EXPECT_EQ(empty.checkedPairs().size(), back.checkedPairs().size());
}

TEST(AttachedBody, MayHangOnALinkThatDoesNotMove) {
  const auto plain = parseArm(armUrdf({}));
  AttachedBody crown{.name = "crown", .link = "base"};
  crown.parts.push_back({Box{{0.02, 0.3, 0.02}}, at(0.2, 0.05, 0.35)});
  World obstacle;
  obstacle.add("bar", Box{{0.02, 0.3, 0.02}}, at(0.2, 0.05, 0.35));
  const Checker attached = Checker(plain, "all", shared({})).withAttached(crown);
  const Checker standing(plain, "all", shared(obstacle));
  agreementOf(attached, standing, 500, 4).expectRepresentative(60);
}

TEST(AttachedBody, WhatALetGoBodyLeavesIsWhereItWas) {
  const auto plain = parseArm(armUrdf({}));
  const auto world = shared(test::clutter(13));
  const Checker holding = Checker(plain, "all", world).withAttached(tool());
  const std::vector<double> q{0.4, -0.9};
  const WorldBody left = holding.detachedBody("tool", q);
  EXPECT_EQ(left.name, "tool");
  ASSERT_EQ(left.parts.size(), 2U);
  const Checker released = holding.withoutAttached("tool").withBody(left);
  // A second tool, attached where the first was, coincides with what was left.
  const Checker again = released.withAttached(tool("second"));
  Workspace workspace(again);
  const StateReport report = again.reportState(q, workspace);
  ASSERT_FALSE(report.contacts.empty());
  const auto* same = again.world().find("tool");
  ASSERT_NE(same, nullptr);
  const WorldBody second = again.detachedBody("second", q);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_TRUE(second.parts[i].world_from_shape.isApprox(same->parts[i].world_from_shape, 1e-14));
  EXPECT_EQ(messageOf([&] { (void)released.detachedBody("tool", q); }),
            "Checker: there is no attached body 'tool'");
  EXPECT_EQ(messageOf([&] {
              (void)holding.detachedBody("tool", std::vector<double>{NAN, 0.0});
            }),
            "Checker: no pose of 'tool' is known in a configuration that is not finite");
}

TEST(AttachedBody, ImpossibleOnesAreErrors) {
  const Checker checker(parseArm(armUrdf({})), "all", shared(test::clutter(1)));
  const auto attach = [&](const AttachedBody& body) {
    return messageOf([&] { (void)checker.withAttached(body); });
  };
  AttachedBody body = tool();
  body.link = "paw";
  EXPECT_EQ(
      attach(body),
      "Checker: attached body 'tool' is attached to link 'paw', which the robot does not have");
  body = tool();
  body.touchLinks = {"finger"};
  EXPECT_EQ(attach(body),
            "Checker: attached body 'tool' has touch link 'finger', which the robot does not have");
  EXPECT_EQ(attach(tool("fore")),
            "Checker: attached body 'fore' has the name of a link or another one");
  EXPECT_EQ(attach(tool("")), "Checker: attached body '' has no name");
  EXPECT_EQ(attach(tool("body1")), "Checker: the world has a body 'body1', and so has the robot");
  body = tool();
  body.parts[0].shape = makePlane({0, 0, 1}, 0.0);
  EXPECT_EQ(attach(body),
            "Checker: attached body 'tool' has a plane or a half-space, which cannot move");
  body = tool();
  body.parts[1].link_from_shape.linear() *= 2.0;
  EXPECT_EQ(attach(body),
            "Checker: attached body 'tool' has a part whose pose is no finite rigid transform");
  EXPECT_EQ(messageOf([&] { (void)checker.withoutAttached("tool"); }),
            "Checker: there is no attached body 'tool'");
  const Checker holding = checker.withAttached(tool());
  EXPECT_EQ(messageOf([&] { (void)holding.withAttached(tool()); }),
            "Checker: attached body 'tool' has the name of a link or another one");
  EXPECT_EQ(
      messageOf([&] {
        (void)holding.withBody(WorldBody{.name = "tool", .parts = {{Sphere{0.1}, at(1, 0, 0)}}});
      }),
      "Checker: the world has a body 'tool', and so has the robot");
}

}  // namespace
}  // namespace swept
