// SPDX-License-Identifier: BSD-3-Clause
// Bodies of one shape, given by name, shape and pose, are the bodies that the structs describe.
#include <gtest/gtest.h>

#include "message_of.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using test::messageOf;

constexpr const char* kUrdf = R"(<robot name='slide'>
  <link name='base'/>
  <link name='hand'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>
  <link name='finger'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>
  <joint name='x' type='prismatic'><parent link='base'/><child link='hand'/>
    <axis xyz='1 0 0'/><limit lower='-9' upper='9' effort='1' velocity='1'/></joint>
  <joint name='grip' type='prismatic'><parent link='hand'/><child link='finger'/>
    <origin xyz='0 0.3 0'/><axis xyz='0 1 0'/>
    <limit lower='0' upper='1' effort='1' velocity='1'/></joint>
</robot>)";

Isometry3d at(double x, double y = 0.0) {
  return Isometry3d(Translation3d(x, y, 0));
}

class OneShapeBodies : public testing::Test {
 protected:
  static StateReport report(const Checker& checker, double x) {
    Workspace workspace(checker);
    return checker.reportState({x, 0.0}, workspace);
  }
  /// m, from the robot at x to the world.
  static double clearance(const Checker& checker, double x) {
    return report(checker, x).world.clearance;
  }
  Checker empty_{Robot::parse(kUrdf, "slide.urdf"), "all", std::make_shared<const World>()};
};

TEST_F(OneShapeBodies, StandInTheWorld) {
  const Checker with = empty_.withBody("post", makeSphere(0.2), at(2));
  ASSERT_EQ(with.world().bodies().size(), 1u);
  EXPECT_EQ(with.world().find("post")->parts.size(), 1u);
  EXPECT_NEAR(clearance(with, 0.5), 1.2, 1e-9);
  const Checker moved = with.withReplaced("post", makeBox({0.2, 2, 2}), at(3));
  EXPECT_NEAR(clearance(moved, 0.5), 2.3, 1e-9);
  EXPECT_NEAR(clearance(with, 0.5), 1.2, 1e-9);

  EXPECT_EQ(messageOf([&] { (void)with.withBody("post", makeSphere(0.2), at(1)); }),
            "World: a second body is named 'post'");
  EXPECT_EQ(messageOf([&] { (void)with.withReplaced("past", makeSphere(0.2), at(1)); }),
            messageOf([&] { (void)with.withReplaced({.name = "past"}); }));
  Isometry3d bent = at(1);
  bent.linear() *= 2.0;
  for (const auto& message :
       {messageOf([&] { (void)with.withBody("other", makeSphere(0.2), bent); }),
        messageOf([&] { (void)with.withReplaced("other", makeSphere(0.2), bent); })})
    EXPECT_NE(message, "");
}

TEST_F(OneShapeBodies, AreReplacedInAWorld) {
  World world;
  world.add("post", makeSphere(0.2), at(2));
  world.replace("post", makeSphere(0.3), at(1));
  ASSERT_EQ(world.bodies().size(), 1u);
  EXPECT_EQ(std::get<Sphere>(world.find("post")->parts[0].shape).radius, 0.3);
  EXPECT_EQ(world.find("post")->parts[0].world_from_shape.translation().x(), 1.0);
}

TEST_F(OneShapeBodies, AreCarried) {
  const Checker post = empty_.withBody("post", makeSphere(0.1), at(2));
  // A rod that reaches 0.5 m ahead of the hand.
  const Checker rod = post.withAttached("rod", "hand", makeBox({1.0, 0.02, 0.02}), at(0));
  EXPECT_NEAR(clearance(rod, 0.0), 2.0 - 0.1 - 0.5, 1e-9);
  EXPECT_EQ(rod.options().attached.at(0).link, "hand");
  // A block that reaches to the finger touches it, if it may.
  const Shape block = makeBox({0.4, 1.0, 0.2});
  EXPECT_EQ(report(post.withAttached("block", "hand", block, at(0)), 0.0).verdict,
            Verdict::Collision);
  const Checker held = post.withAttached("block", "hand", block, at(0), {"finger"});
  EXPECT_EQ(report(held, 0.0).verdict, Verdict::Free);
  EXPECT_NEAR(clearance(held, 0.0), 2.0 - 0.1 - 0.2, 1e-9);
  EXPECT_EQ(messageOf([&] { (void)held.withAttached("block", "hand", block, at(0)); }),
            messageOf([&] { (void)held.withAttached({.name = "block", .link = "hand"}); }));
  EXPECT_NE(messageOf([&] { (void)post.withAttached("block", "hund", block, at(0)); }), "");
}

}  // namespace
}  // namespace swept
