// SPDX-License-Identifier: BSD-3-Clause
// What rounding makes of coordinates, angles and times that are large: nothing is called free that
// is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "../core/mesh_samples.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/link_motion.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d at(double x, double y, double z) {
  return Isometry3d(Eigen::Translation3d(x, y, z));
}

/// A ball on a joint: it slides along z, or turns about it 1 m away.
std::shared_ptr<const Robot> ballOn(const std::string& joint, double radius) {
  const bool turns = joint == "continuous";
  return Robot::parse(
      "<robot name='r'><link name='base'/><link name='ball'><collision><origin xyz='" +
          std::string(turns ? "1 0 0" : "0 0 0") + "'/><geometry><sphere radius='" +
          std::to_string(radius) + "'/></geometry></collision></link><joint name='j' type='" +
          joint + "'><parent link='base'/><child link='ball'/><axis xyz='0 0 1'/>" +
          (turns ? "" : "<limit lower='-1' upper='1' effort='1' velocity='1'/>") +
          "</joint></robot>",
      "r.urdf");
}

Checker checkerIn(const std::shared_ptr<const Robot>& robot, World world) {
  return {robot, "all", std::make_shared<const World>(std::move(world))};
}

TriangleMesh slab(double low, double high) {
  const test::Soup soup = test::boxSoup({-1.0, -1.0, low}, {1.0, 1.0, high});
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

/// As of a survey: vertices millions of metres from their frame, which is as far the other way.
TEST(Rounding, OfMeshesFarFromTheirOwnFrame) {
  constexpr double kRadius = 0.0625;
  const auto robot = ballOn("prismatic", kRadius);
  for (const double far : {5e5, 5e6, 1e9}) {
    const double ulp = std::nextafter(far, INFINITY) - far;
    World world;
    world.add("slab", slab(far, far + 0.5 + 3.0 * ulp), at(0.0, 0.0, -far));
    const Checker checker = checkerIn(robot, std::move(world));
    Workspace workspace(checker);
    const std::vector<double> below{-0.5}, inside{-kRadius + 0.45 * ulp};
    EXPECT_NE(checker.checkState(inside, workspace), Verdict::Free) << far;
    EXPECT_NE(checker.certifyMotion(below, inside, workspace).verdict, Verdict::Free) << far;
    EXPECT_EQ(checker.checkState(below, workspace), Verdict::Free) << far;
  }
}

/// The other way round: a link's.
TEST(Rounding, OfLinksFarFromTheirOwnFrame) {
  for (const double far : {5e6, 1e9}) {
    const double ulp = std::nextafter(far, INFINITY) - far;
    const auto robot = ballOn("prismatic", 0.0625);
    AttachedBody load{.name = "load", .link = "ball"};
    load.parts = {{slab(far, far + 0.5 + 3.0 * ulp), at(0.0, 0.0, 0.2 - far)}};
    World world;
    world.add("ball", makeSphere(0.0625), at(0.0, 0.0, 0.5));
    const Checker checker = checkerIn(robot, std::move(world)).withAttached(load);
    Workspace workspace(checker);
    // Its upper side is at 0.7 m and more, the ball's lower one at 0.4375 m.
    const std::vector<double> below{-0.5}, inside{-0.2625 - 2.6 * ulp};
    EXPECT_NE(checker.checkState(inside, workspace), Verdict::Free) << far;
    EXPECT_NE(checker.certifyMotion(below, inside, workspace).verdict, Verdict::Free) << far;
    EXPECT_EQ(checker.checkState(below, workspace), Verdict::Free) << far;
  }
}

TEST(Rounding, OfLargeAngles) {
  const auto robot = ballOn("continuous", 0.001);
  for (const double large : {1e3, 1e6, 1e9, 1e12, 1e13, 1e14, 1e15}) {
    World world;
    world.add("ball", makeSphere(1e-6), at(std::cos(large), std::sin(large), 0.0));
    const Checker checker = checkerIn(robot, std::move(world));
    Workspace workspace(checker);
    const double there = std::atan2(std::sin(large), std::cos(large));
    for (const double way : {0.3, -0.3, 0.01, -2.0}) {
      const std::vector<double> from{there + way}, to{large};
      EXPECT_NE(checker.certifyMotion(from, to, workspace).verdict, Verdict::Free)
          << large << " " << way;
      EXPECT_NE(checker.certifyMotion(to, from, workspace).verdict, Verdict::Free)
          << large << " " << way;
    }
    // Far enough from it nothing changes.
    const std::vector<double> from{large - 2.0}, to{large - 1.0};
    if (large < 1e14) {
      EXPECT_EQ(checker.certifyMotion(from, to, workspace).verdict, Verdict::Free) << large;
    }
  }
}

TEST(Rounding, OfLargeAnglesIsStatedByLinkMotion) {
  const auto robot = ballOn("continuous", 0.001);
  for (const double large : {1e3, 1e6, 1e9, 1e12, 1e15}) {
    const double near = std::atan2(std::sin(large), std::cos(large)) + 0.3;
    for (const bool there : {true, false}) {
      const std::vector<double> from{there ? near : large}, to{there ? large : near};
      const LinkMotion motion(*robot, "all", "ball", from, to);
      const Vector3d tip = motion.at(there ? 1.0 : 0.0) * Vector3d::UnitX();
      EXPECT_LE((tip - Vector3d(std::cos(large), std::sin(large), 0.0)).norm(),
                motion.rounding(1.0))
          << large;
    }
  }
}

/// Of a follower whose offset takes back most of what its master's angle is times a factor.
TEST(Rounding, OfLargeAnglesThatAnOffsetTakesBack) {
  constexpr double kFactor = 1e6, kOffset = -1e12, kRadius = 1e-6;
  const auto robot = Robot::parse(
      R"(<robot name='r'><link name='base'/><link name='knob'/><link name='ball'><collision>
      <origin xyz='1 0 0'/><geometry><sphere radius='1e-6'/></geometry></collision></link>
      <joint name='knob' type='continuous'><parent link='base'/><child link='knob'/>
      <axis xyz='0 0 1'/></joint>
      <joint name='dial' type='continuous'><parent link='base'/><child link='ball'/>
      <axis xyz='0 0 1'/><mimic joint='knob' multiplier='1e6' offset='-1e12'/></joint></robot>)",
      "r.urdf");
  int far = 0;
  for (int i = 0; i < 100; ++i) {
    const double q = std::nextafter(1e6 - 1e-7 * i, 0.0);
    const double turned = kFactor * q + kOffset;
    const double angle = std::fma(kFactor, q, kOffset);  // with one rounding, of the sum
    if (!(std::abs(turned - angle) > 10.0 * kRadius)) continue;
    ++far;
    World world;
    world.add("ball", makeSphere(kRadius), at(std::cos(angle), std::sin(angle), 0.0));
    const Checker checker = checkerIn(robot, std::move(world));
    Workspace workspace(checker);
    const double away = turned > angle ? 1e-7 : -1e-7;
    const std::vector<double> from{q}, to{std::remainder(q, 2.0 * std::numbers::pi) + away};
    EXPECT_NE(checker.certifyMotion(from, to, workspace).verdict, Verdict::Free) << i;
  }
  EXPECT_GT(far, 50);
}

/// The same of one that slides: `master` is the middle of its master's range, of half this width.
void expectNoFreeSlide(double factor, double master, double width, double radius) {
  const double offset = -factor * master;
  std::ostringstream urdf;
  urdf.precision(17);
  urdf << "<robot name='r'><link name='base'/><link name='knob'/><link name='ball'><collision>"
       << "<geometry><sphere radius='" << radius << "'/></geometry></collision></link>"
       << "<joint name='knob' type='prismatic'><parent link='base'/><child link='knob'/>"
       << "<axis xyz='0 0 1'/><limit lower='" << master - width << "' upper='" << master + width
       << "' effort='1' velocity='1'/></joint>"
       << "<joint name='rail' type='prismatic'><parent link='base'/><child link='ball'/>"
       << "<axis xyz='1 0 0'/><limit lower='-10' upper='10' effort='1' velocity='1'/>"
       << "<mimic joint='knob' multiplier='" << factor << "' offset='" << offset
       << "'/></joint></robot>";
  const auto robot = Robot::parse(urdf.str(), "r.urdf");
  int far = 0;
  for (int i = 0; i < 200; ++i) {
    const double q = std::nextafter(master + 0.007 * width * (i - 100), 0.0);
    const double slid = factor * q + offset;
    const double place = std::fma(factor, q, offset);  // with one rounding, of the sum
    if (!(std::abs(slid - place) > 10.0 * radius)) continue;
    ++far;
    World world;
    world.add("ball", makeSphere(radius), at(place, 0.0, 0.0));
    const Checker checker = checkerIn(robot, std::move(world));
    Workspace workspace(checker);
    const double away = 1e-3 * width;
    const std::vector<double> from{q}, to{q + (slid > place ? away : -away)};
    EXPECT_NE(checker.certifyMotion(from, to, workspace).verdict, Verdict::Free) << i;
    EXPECT_NE(checker.checkState(from, workspace), Verdict::Free) << i;
    const LinkMotion motion(*robot, "all", "ball", from, to);
    EXPECT_LE(std::abs(motion.at(0.0).translation().x() - place), motion.rounding(0.0)) << i;
  }
  EXPECT_GT(far, 50);
}

TEST(Rounding, OfLargeSlidesThatAnOffsetTakesBack) {
  expectNoFreeSlide(1e6, 1e6, 7e-6, 1e-6);
}

/// Minute ones, in which a small offset is as much.
TEST(Rounding, OfMinuteSlidesThatAnOffsetTakesBack) {
  expectNoFreeSlide(3.0, 33333.3, 3e-8, 1e-14);
}

/// A pose from a file with nine digits is taken for a rotation, and its transpose for its inverse.
TEST(Rounding, OfPosesIsTakenOffWhenTheyComeIn) {
  Isometry3d pose = at(50.0, 0.0, 0.0);
  pose.linear() = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  pose.linear().col(0) *= 1.0 + 4e-10;
  const auto defect = [](const Isometry3d& placed) {
    const Eigen::Matrix3d r = placed.linear();
    return (r * r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  };
  ASSERT_GT(defect(pose), 1e-10);
  World world;
  world.add("floor", makeBox({100.0, 100.0, 1.0}), pose);
  EXPECT_LT(defect(world.find("floor")->parts.front().world_from_shape), 1e-14);
  world.replace({.name = "floor", .parts = {{makeSphere(1.0), pose}}});
  EXPECT_LT(defect(world.find("floor")->parts.front().world_from_shape), 1e-14);
  EXPECT_EQ(world.find("floor")->parts.front().world_from_shape.translation(), pose.translation());
  MovingObstacle obstacle{.name = "drone", .parts = {{makeSphere(1.0), pose}}};
  obstacle.waypoints.push_back({0.0, pose});
  world.add(obstacle);
  EXPECT_LT(defect(world.findObstacle("drone")->parts.front().body_from_shape), 1e-14);
  EXPECT_LT(defect(world.findObstacle("drone")->waypoints.front().world_from_body), 1e-14);
}

MovingObstacle ballThrough(const std::vector<MovingObstacle::Waypoint>& waypoints) {
  MovingObstacle obstacle{.name = "drone", .parts = {{makeSphere(0.05), Isometry3d::Identity()}}};
  obstacle.waypoints = waypoints;
  return obstacle;
}

/// Where it goes from one place to another at once, or nearly.
TEST(Rounding, OfTimesBetweenWaypoints) {
  for (const double span : {20.0, 1e3, 1e17, 1e20, 1e308}) {
    for (const double jump : {1e-6, 1e-12, 1.8e-15}) {
      World world;
      world.add(ballThrough({{0.0, at(5.0, 0.0, 0.0)},
                             {10.0, at(5.0, 0.0, 0.0)},
                             {10.0 + jump, at(0.0, 0.0, 0.0)},
                             {20.0, at(0.0, 3.0, 0.0)}}));
      const Checker checker = checkerIn(ballOn("prismatic", 0.05), std::move(world));
      Workspace workspace(checker);
      const std::vector<double> early{0.0, -span}, late{0.0, span}, met{0.0, 10.1};
      ASSERT_EQ(checker.checkState(met, workspace), Verdict::Collision);
      for (const bool forwards : {true, false}) {
        const auto& from = forwards ? early : late;
        const auto& to = forwards ? late : early;
        EXPECT_NE(checker.certifyMotion(from, to, workspace).verdict, Verdict::Free)
            << span << " s, " << jump << " s";
        EXPECT_LT(checker.motionClearance(from, to, 1e-3, workspace).lower, 1e-3) << span;
      }
    }
  }
}

/// Which way round, rounding decides: for states and motions the same.
TEST(Rounding, OfHalfATurnOfAnObstacle) {
  const auto robot = ballOn("prismatic", 0.05);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto vector = [&] {
    const double x = normal(random), y = normal(random);
    return Vector3d(x, y, normal(random));
  };
  int met = 0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::AngleAxisd first(normal(random), vector().normalized());
    const Vector3d axis = vector().normalized();
    const Vector3d target = 0.5 * axis.unitOrthogonal();
    MovingObstacle obstacle{.name = "arm"};
    for (const double turn : {0.0, std::numbers::pi * (1.0 + (i % 3 - 1) * 1e-16)}) {
      Isometry3d pose = at(-target.x(), -target.y(), -target.z());
      pose.linear() = (Eigen::AngleAxisd(turn, axis) * first).toRotationMatrix();
      obstacle.waypoints.push_back({turn > 0.0 ? 1.0 : 0.0, pose});
    }
    Isometry3d tip = Isometry3d::Identity();
    tip.translation() = obstacle.poseAt(0.5).linear().transpose() * target;
    obstacle.parts = {{makeSphere(0.05), tip}};
    World world;
    world.add(obstacle);
    const Checker checker = checkerIn(robot, std::move(world));
    Workspace workspace(checker);
    met += checker.checkState(std::vector<double>{0.0, 0.5}, workspace) == Verdict::Collision;
    for (const double end : {1.0, std::nextafter(1.0, 0.0), 0.9})
      EXPECT_NE(checker
                    .certifyMotion(std::vector<double>{0.0, 0.0}, std::vector<double>{0.0, end},
                                   workspace)
                    .verdict,
                Verdict::Free)
          << i << " until " << end;
  }
  EXPECT_EQ(met, 1000);
}

}  // namespace
}  // namespace swept
