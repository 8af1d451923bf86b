// SPDX-License-Identifier: BSD-3-Clause
// What a version of a checker and a workspace take, in KB of heap.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>

#include "heap_counter.hpp"
#include "model_robots.hpp"
#include "version_arms.hpp"

namespace swept {
namespace {

using test::at;

/// KB that what `make` returns holds, beyond what there was before.
template <typename Make>
double kilobytesOf(const std::string& what, const Make& make) {
  const long before = test::heldBytes;
  const auto made = make();
  const double kilobytes = static_cast<double>(test::heldBytes - before) / 1024.0;
  testing::Test::RecordProperty(what, std::to_string(kilobytes));
  std::printf("%s: %.1f KB\n", what.c_str(), kilobytes);
  return kilobytes;
}

/// Six joints, meshes and primitives, a world of boxes.
class CheckerMemory : public testing::Test {
 protected:
  CheckerMemory()
      : world_(std::make_shared<World>(test::clutter(1, 12))), robot_(test::modelRobot("rook6")) {
    base_.emplace(robot_, robot_->groups().front().name, world_);
  }

  std::shared_ptr<const World> world_;
  std::shared_ptr<const Robot> robot_;
  std::optional<Checker> base_;
};

TEST_F(CheckerMemory, OfAVersionIsAFractionOfAChecker) {
  const double whole =
      kilobytesOf("checker", [&] { return Checker(robot_, base_->group().name, world_); });
  EXPECT_LT(whole, 4000.0);
  const double body = kilobytesOf("version with a body more", [&] {
    return base_->withBody({.name = "ball", .parts = {{Sphere{0.1}, at(1, 0, 1)}}});
  });
  EXPECT_LT(body, 64.0);
  const double rules = kilobytesOf("version with other rules", [&] {
    return base_->withRules(CollisionRules().pad("*", 0.01));
  });
  EXPECT_LT(rules, 64.0);
  // The covers of all links are copied to make room for one more.
  const double attached = kilobytesOf("version with an attached body", [&] {
    return base_->withAttached({.name = "gripped",
                                .link = robot_->links().back().name,
                                .parts = {{Box{{0.05, 0.05, 0.05}}, at(0, 0, 0.1)}}});
  });
  EXPECT_LT(attached, 1000.0);
  EXPECT_LT(10.0 * body, whole);
}

TEST_F(CheckerMemory, OfAWorkspace) {
  EXPECT_LT(kilobytesOf("workspace", [&] { return Workspace(*base_); }), 64.0);
  // Used, it has room for what queries need.
  EXPECT_LT(kilobytesOf("used workspace",
                        [&] {
                          Workspace workspace(*base_);
                          std::mt19937 random(1);
                          for (int i = 0; i < 500; ++i) {
                            const auto from = test::randomConfiguration(*base_, random);
                            const auto to = test::randomConfiguration(*base_, random);
                            (void)base_->certifyMotion(from, to, workspace);
                            (void)base_->clearance(to, workspace);
                          }
                          return workspace;
                        }),
            256.0);
}

/// Witnesses and clearances name bodies: none of these names fits into a std::string itself.
TEST(QueryMemory, LongNamesAllocateNothing) {
  const std::string longName(200, 'n');
  std::string urdf = "<robot name='long'>" + test::urdfLink(longName + "0", {});
  for (int i = 1; i <= 3; ++i) {
    const std::string name = longName + std::to_string(i);
    const std::string parent = longName + std::to_string(i - 1);
    urdf += test::urdfLink(name, {{test::box(0.05, 0.05, 0.4), {0, 0, 0.2}}}) +
            test::urdfJoint("joint" + std::to_string(i), "revolute", parent, name,
                            "<origin xyz='0 0 0.42'/><axis xyz='0 1 0'/>"
                            "<limit lower='-3' upper='3' effort='1' velocity='1'/>");
  }
  auto world = std::make_shared<World>();
  world->add(longName + " of the world", Box{{0.1, 0.1, 0.1}}, at(0.5, 0, 0.5));
  const Checker checker(Robot::parse(urdf + "</robot>", "long.urdf"), "all", world);
  Workspace workspace(checker);

  int collisions = 0;
  int ofSelf = 0;
  long taken = 0;
  for (int round = 0; round < 2; ++round) {  // the first makes room in the workspace
    std::mt19937 random(5);
    std::uniform_real_distribution<double> angle(-3, 3);
    collisions = ofSelf = 0;
    taken = test::allocations;
    for (int i = 0; i < 300; ++i) {
      std::array<double, 3> from{};
      std::array<double, 3> to{};
      for (int j = 0; j < 3; ++j) {
        from[j] = angle(random);
        to[j] = angle(random);
      }
      const MotionCertificate certificate = checker.certifyMotion(from, to, workspace);
      collisions += certificate.witness ? 1 : 0;
      ofSelf += certificate.witness && certificate.witness->selfPair ? 1 : 0;
      (void)checker.certifyMotion(from, to, workspace, MotionQuery::VerdictOnly);
      (void)checker.checkState(to, workspace);
      (void)checker.clearance(to, workspace);
      (void)checker.signedClearance(to, workspace);
      (void)checker.motionClearance(from, to, 1e-3, workspace);
    }
    taken = test::allocations - taken;
  }
  EXPECT_EQ(taken, 0);
  EXPECT_GT(ofSelf, 20);
  EXPECT_GT(collisions - ofSelf, 20);
}

TEST_F(CheckerMemory, ALongLineOfVersionsDoesNotGrow) {
  const auto change = [&](const Checker& checker, int i) {
    const std::string name = "ball" + std::to_string(i % 2);
    const Checker with = checker.withBody({.name = name, .parts = {{Sphere{0.1}, at(1, 0, 1)}}})
                             .withAttached({.name = "gripped",
                                            .link = robot_->links().back().name,
                                            .parts = {{Sphere{0.05}, at(0, 0, 0.1)}}})
                             .withRules(CollisionRules().pad(name, 0.02));
    return with.withoutAttached("gripped").withoutBody(name);
  };
  Checker version = change(*base_, 0);
  const long before = test::heldBytes;
  for (int i = 0; i < 50; ++i) version = change(version, i);
  EXPECT_LT(static_cast<double>(test::heldBytes - before) / 1024.0, 16.0);
}

}  // namespace
}  // namespace swept
