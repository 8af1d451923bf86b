// SPDX-License-Identifier: BSD-3-Clause
// An obstacle that slides or turns evenly is a link on a joint of its own: the same motions,
// checked as those of a robot with one link more.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "version_arms.hpp"

namespace swept {
namespace {

using test::armUrdf;
using test::at;
using test::box;
using test::compare;
using test::messageOf;
using test::parseArm;
using test::shared;
using test::sphere;
using testing::HasSubstr;

const Eigen::Vector3d kStart{0.5, -0.6, 0.5};
const Eigen::Vector3d kWay{-0.9, 1.1, 0.2};

/// A ball that slides along kWay from kStart and a bar that turns about z.
std::string movingLinks() {
  const std::string limits = R"(<limit lower="-9" upper="9" effort="1" velocity="1"/>)";
  const Eigen::Vector3d axis = kWay.normalized();
  return test::urdfLink("nothing", {}) + test::urdfLink("ball", {{sphere(0.12), {0, 0, 0}}}) +
         test::urdfLink("bar", {{box(0.6, 0.05, 0.05), {0.2, 0, 0}}}) +
         test::urdfJoint("nail", "fixed", "base", "nothing", "") +
         test::urdfJoint("slide", "prismatic", "nothing", "ball",
                         "<origin xyz=\"0.5 -0.6 0.5\"/><axis xyz=\"" + std::to_string(axis.x()) +
                             " " + std::to_string(axis.y()) + " " + std::to_string(axis.z()) +
                             "\"/>" + limits) +
         test::urdfJoint("spin", "revolute", "nothing", "bar",
                         R"(<origin xyz="-0.5 0 0.6"/><axis xyz="0 0 1"/>)" + limits);
}

/// Between 2 s and 5 s.
World movingWorld() {
  World world;
  MovingObstacle ball{.name = "ball", .parts = {{Sphere{0.12}, at(0, 0, 0)}}};
  ball.waypoints.push_back({2.0, Eigen::Isometry3d(Eigen::Translation3d(kStart))});
  ball.waypoints.push_back({5.0, Eigen::Isometry3d(Eigen::Translation3d(kStart + kWay))});
  world.add(ball);
  MovingObstacle bar{.name = "bar", .parts = {{Box{{0.3, 0.025, 0.025}}, at(0.2, 0, 0)}}};
  const Eigen::Isometry3d first = at(-0.5, 0.0, 0.6);
  bar.waypoints.push_back({2.0, first});
  bar.waypoints.push_back({5.0, first * Eigen::AngleAxisd(2.5, Eigen::Vector3d::UnitZ())});
  world.add(bar);
  return world;
}

/// Two of the same: one with obstacles, one whose robot has them as links.
class BothWays {
 public:
  BothWays()
      : arm(parseArm(armUrdf({}))),
        more(parseArm(armUrdf({}, movingLinks()),
                      "<robot name=\"arm\"><disable_collisions link1=\"ball\" link2=\"bar\" "
                      "reason=\"world\"/></robot>")),
        moving(arm, "all", shared(movingWorld())),
        linked(more, "all", shared({})) {}

  /// What the links' joints are at a time.
  std::vector<double> asLinks(const std::vector<double>& q) const {
    const double share = (std::clamp(q.back(), 2.0, 5.0) - 2.0) / 3.0;
    std::vector<double> values(3 + 1);
    const auto set = [&](const char* name, double value) {
      const auto& variables = linked.group().variables;
      const int wanted = *more->findVariable(name);
      values[static_cast<std::size_t>(std::ranges::find(variables, wanted) - variables.begin())] =
          value;
    };
    set("yaw", q[0]);
    set("elbow", q[1]);
    set("slide", share * kWay.norm());
    set("spin", share * 2.5);
    return values;
  }

  std::vector<double> random(std::mt19937& engine, double early, double late) const {
    std::vector<double> q = test::randomConfiguration(moving, engine);
    q.push_back(std::uniform_real_distribution<double>(early, late)(engine));
    return q;
  }

  std::shared_ptr<const Robot> arm, more;
  Checker moving, linked;
};

TEST(MovingObstacle, IsALinkOnAJointOfItsOwn) {
  const BothWays both;
  EXPECT_EQ(both.moving.dimension(), 3);
  EXPECT_EQ(both.linked.dimension(), 4);
  Workspace ofMoving(both.moving);
  Workspace ofLinked(both.linked);
  std::mt19937 engine(5);
  test::Agreement states;
  test::Agreement motions;
  for (int i = 0; i < 600; ++i) {
    const std::vector<double> from = both.random(engine, 2.0, 5.0);
    std::vector<double> to = both.random(engine, 2.0, 5.0);
    for (std::size_t k = 0; k < 2; ++k) to[k] = from[k] + 0.3 * (to[k] - from[k]);
    compare(both.moving.checkState(from, ofMoving),
            both.linked.checkState(both.asLinks(from), ofLinked), states);
    const MotionCertificate one = both.moving.certifyMotion(from, to, ofMoving);
    const MotionCertificate other =
        both.linked.certifyMotion(both.asLinks(from), both.asLinks(to), ofLinked);
    compare(one.verdict, other.verdict, motions);
    EXPECT_NEAR(one.freeUntil, other.freeUntil, 0.01);
    const MotionClearance near = both.moving.motionClearance(from, to, 1e-3, ofMoving);
    const MotionClearance same =
        both.linked.motionClearance(both.asLinks(from), both.asLinks(to), 1e-3, ofLinked);
    EXPECT_LE(near.lower, same.upper + 1e-9);
    EXPECT_LE(same.lower, near.upper + 1e-9);
    EXPECT_NEAR(both.moving.clearance(from, ofMoving),
                both.linked.clearance(both.asLinks(from), ofLinked), 1e-6);
  }
  states.expectRepresentative(60);
  motions.expectRepresentative(60);
}

TEST(MovingObstacle, WaypointsInAMotionTakeItApart) {
  // Before 2 s and after 5 s everything stands still; a motion over more than that has three parts.
  const BothWays both;
  Workspace ofMoving(both.moving);
  Workspace ofLinked(both.linked);
  std::mt19937 engine(6);
  test::Agreement motions;
  int later = 0;
  for (int i = 0; i < 500; ++i) {
    std::vector<double> from = both.random(engine, 0.0, 1.9);
    std::vector<double> to = both.random(engine, 5.1, 7.0);
    if (i % 4 == 0) std::swap(from.back(), to.back());  // time may run backwards
    for (std::size_t k = 0; k < 2; ++k) to[k] = from[k] + 0.3 * (to[k] - from[k]);
    const MotionCertificate whole = both.moving.certifyMotion(from, to, ofMoving);
    double freeUntil = 1.0;
    Verdict verdict = Verdict::Free;
    double begin = 0.0;
    std::vector<double> passages{(2.0 - from.back()) / (to.back() - from.back()),
                                 (5.0 - from.back()) / (to.back() - from.back()), 1.0};
    std::ranges::sort(passages);
    for (const double end : passages) {
      const auto on = [&](double t) {
        const Eigen::VectorXd q = both.moving.interpolate(from, to, t);
        return both.asLinks({q.data(), q.data() + 3});
      };
      const MotionCertificate part = both.linked.certifyMotion(on(begin), on(end), ofLinked);
      if (part.verdict != Verdict::Free) {
        verdict = part.verdict;
        freeUntil = begin + part.freeUntil * (end - begin);
        break;
      }
      begin = end;
    }
    compare(whole.verdict, verdict, motions);
    EXPECT_NEAR(whole.freeUntil, freeUntil, 0.01);
    const MotionClearance near = both.moving.motionClearance(from, to, 0.01, ofMoving);
    EXPECT_LE(near.lower, near.upper);
    EXPECT_GE(near.lower, near.upper - 0.01);
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const Eigen::VectorXd q = both.moving.interpolate(from, to, t);
      EXPECT_GE(both.moving.clearance({q.data(), 3}, ofMoving), near.lower - 1e-6);
    }
    if (whole.verdict != Verdict::Collision) continue;
    EXPECT_GE(whole.witness->t, whole.freeUntil);
    later += whole.witness->t > passages[0] ? 1 : 0;
    // The witness is at that time of the clock.
    const Eigen::VectorXd hit = both.moving.interpolate(from, to, whole.witness->t);
    EXPECT_NE(both.moving.checkState({hit.data(), 3}, ofMoving), Verdict::Free);
  }
  motions.expectRepresentative(60);
  EXPECT_GT(later, 30) << "contacts in later parts are of interest";
}

TEST(MovingObstacle, AFastBallDoesNotTunnel) {
  // It crosses the standing arm within a thousandth of the motion's time.
  World world;
  MovingObstacle ball{.name = "ball", .parts = {{Sphere{0.01}, at(0, 0, 0)}}};
  ball.waypoints.push_back({0.4995, at(0.0, -400.0, 0.3)});
  ball.waypoints.push_back({0.5005, at(0.0, 400.0, 0.3)});
  world.add(ball);
  const Checker checker(parseArm(armUrdf({})), "all", shared(world));
  Workspace workspace(checker);
  const std::vector<double> from{0.0, 0.0, 0.0};
  const std::vector<double> to{0.0, 0.0, 1.0};
  EXPECT_EQ(checker.checkState(from, workspace), Verdict::Free);
  EXPECT_EQ(checker.checkState(to, workspace), Verdict::Free);
  const MotionCertificate certificate = checker.certifyMotion(from, to, workspace);
  ASSERT_EQ(certificate.verdict, Verdict::Collision);
  EXPECT_EQ(certificate.witness->bodyB, "ball");
  EXPECT_NEAR(certificate.witness->t, 0.5, 1e-6);
  EXPECT_LE(certificate.freeUntil, 0.5);
  EXPECT_GT(certificate.freeUntil, 0.4999);
}

TEST(MovingObstacle, ACornerOfItsWayIsNotCut) {
  // The ball goes down to the arm and up again; a straight way would stay above it. The times are
  // those of a clock that has been running for years.
  const double now = 1.76e9;
  World world;
  MovingObstacle ball{.name = "ball", .parts = {{Sphere{0.05}, at(0, 0, 0)}}};
  ball.waypoints.push_back({now, at(-1.0, 0.0, 1.4)});
  ball.waypoints.push_back({now + 1.0, at(0.0, 0.0, 0.8 + 0.17)});
  ball.waypoints.push_back({now + 2.0, at(1.0, 0.0, 1.4)});
  world.add(ball);
  const Checker checker(parseArm(armUrdf({})), "all", shared(world));
  Workspace workspace(checker);
  // The hand's ball ends at z = 0.1 + 0.4 + 0.3 + 0.03; contact below 0.83 + 0.05.
  const MotionCertificate free =
      checker.certifyMotion(std::vector<double>{0.0, 0.0, now - 1.0},
                            std::vector<double>{0.0, 0.0, now + 3.0}, workspace);
  EXPECT_EQ(free.verdict, Verdict::Free);
  const Checker lower = checker.withoutBody("ball").withObstacle([&] {
    ball.waypoints[1].world_from_body = at(0.0, 0.0, 0.86);
    return ball;
  }());
  const MotionCertificate hit =
      lower.certifyMotion(std::vector<double>{0.0, 0.0, now - 1.0},
                          std::vector<double>{0.0, 0.0, now + 3.0}, workspace);
  ASSERT_EQ(hit.verdict, Verdict::Collision);
  EXPECT_NEAR(hit.witness->t, 0.5, 0.05);
}

TEST(MovingObstacle, WhatIsFreeBehindAnUndecidedPartDoesNotCount) {
  // In its first part the ball grazes the hand that stands still, in the second one it goes away.
  MovingObstacle ball{.name = "ball", .parts = {{Sphere{0.05}, at(0, 0, 0)}}};
  ball.waypoints.push_back({0.0, at(-1.0, 0.02, 0.88 + 1e-9)});
  ball.waypoints.push_back({1.0, at(1.0, 0.02, 0.88 + 1e-9)});
  ball.waypoints.push_back({2.0, at(1.0, 0.0, 1.4)});
  const auto certificateTo = [&](double end) {
    World world;
    world.add(ball);
    const Checker checker(parseArm(armUrdf({})), "all", shared(world));
    Workspace workspace(checker);
    return checker.certifyMotion(std::vector<double>{0.0, 0.0, 0.0},
                                 std::vector<double>{0.0, 0.0, end}, workspace);
  };
  const MotionCertificate open = certificateTo(2.0);
  ASSERT_EQ(open.verdict, Verdict::Undecided);
  EXPECT_NEAR(open.undecidedAt, 0.25, 0.05);
  EXPECT_NEAR(open.freeUntil, 0.25, 0.05);
  // Nor does what lies between it and a contact.
  ball.waypoints.push_back({3.0, at(0.0, 0.0, 0.8)});
  ball.waypoints.push_back({4.0, at(1.0, 0.0, 0.8)});
  const MotionCertificate hit = certificateTo(4.0);
  ASSERT_EQ(hit.verdict, Verdict::Collision);
  EXPECT_GT(hit.witness->t, 0.5);
  EXPECT_NEAR(hit.freeUntil, 0.125, 0.025);
}

TEST(MovingObstacle, PadsScalesAndRulesApply) {
  const auto arm = parseArm(armUrdf({}));
  const auto ballOf = [&](double radius) {
    World world;
    MovingObstacle ball{.name = "ball", .parts = {{Sphere{radius}, at(0, 0, 0)}}};
    ball.waypoints.push_back({0.0, at(0.4, -0.8, 0.6)});
    ball.waypoints.push_back({1.0, at(0.4, 0.8, 0.5)});
    world.add(ball);
    return shared(world);
  };
  const auto differing = [&](const Checker& a, const Checker& b) {
    std::mt19937 engine(8);
    Workspace ofA(a);
    Workspace ofB(b);
    test::Agreement agreement;
    for (int i = 0; i < 400; ++i) {
      std::vector<double> from = test::randomConfiguration(a, engine);
      std::vector<double> to = from;
      from.push_back(0.0);
      to.push_back(1.0);
      to[0] += 0.3;
      compare(a.certifyMotion(from, to, ofA).verdict, b.certifyMotion(from, to, ofB).verdict,
              agreement);
    }
    EXPECT_GT(agreement.free, 20);
    return agreement.differing;
  };
  const Checker plain(arm, "all", ballOf(0.1));
  const Checker larger(arm, "all", ballOf(0.2));
  EXPECT_GT(differing(plain, larger), 10);
  EXPECT_EQ(differing(plain.withRules(CollisionRules().pad("ball", 0.1)), larger), 0);
  EXPECT_EQ(differing(plain.withRules(CollisionRules().scale("ball", 2.0)), larger), 0);
  EXPECT_EQ(
      differing(plain.withRules(CollisionRules().allow("b*l", "*")),
                Checker(arm, "all", ballOf(1e-6)).withRules(CollisionRules().allow("ball", "*"))),
      0);
  EXPECT_THAT(plain.explain("ball", "hand"), HasSubstr("checked, keeps more than 0 m"));
  EXPECT_THAT(plain.explain("base", "ball"), HasSubstr(": checked"));
}

TEST(MovingObstacle, TimesThatAreNotFiniteAreUndecided) {
  const BothWays both;
  Workspace workspace(both.moving);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    const std::vector<double> q{0.0, 0.0, bad};
    const std::vector<double> good{0.0, 1.0, 0.0};
    EXPECT_EQ(both.moving.checkState(q, workspace), Verdict::Undecided);
    EXPECT_EQ(both.moving.certifyMotion(good, q, workspace).verdict, Verdict::Undecided);
    EXPECT_EQ(both.moving.certifyMotion(q, good, workspace).freeUntil, 0.0);
    EXPECT_EQ(both.moving.clearance(q, workspace), 0.0);
    EXPECT_FALSE(both.moving.withinLimits(q));
  }
  const std::vector<double> good{1.5, 0.0, 0.0};
  EXPECT_EQ(both.moving.checkState(good, workspace), Verdict::Free);
  EXPECT_TRUE(both.moving.withinLimits(good));
  EXPECT_TRUE(both.moving.reportState(good, workspace).outsideLimits.empty());
}

TEST(MovingObstacle, BatchesOfStatesAreTheSame) {
  const BothWays both;
  Workspace workspace(both.moving);
  std::mt19937 engine(9);
  std::vector<double> states;
  std::vector<Verdict> one;
  for (int i = 0; i < 100; ++i) {
    const std::vector<double> q = both.random(engine, 1.0, 6.0);
    states.insert(states.end(), q.begin(), q.end());
    one.push_back(both.moving.checkState(q, workspace));
  }
  std::vector<Verdict> batch(100);
  both.moving.checkStates(states, batch, workspace);
  EXPECT_EQ(batch, one);
  EXPECT_GT(std::ranges::count(one, Verdict::Collision), 10);
}

TEST(MovingObstacle, ImpossibleOnesAreErrors) {
  World world = test::clutter(1);
  MovingObstacle good{.name = "ball", .parts = {{Sphere{0.1}, at(0, 0, 0)}}};
  good.waypoints.push_back({0.0, at(0, 0, 0)});
  good.waypoints.push_back({1.0, at(1, 0, 0)});
  const auto message = [&](auto&& change) {
    MovingObstacle obstacle = good;
    change(obstacle);
    return messageOf([&] { World(world).add(obstacle); });
  };
  EXPECT_EQ(message([](MovingObstacle&) {}), "");
  EXPECT_EQ(message([](MovingObstacle& o) { o.name = "body1"; }),
            "World: a second body is named 'body1'");
  EXPECT_EQ(message([](MovingObstacle& o) { o.waypoints.clear(); }),
            "World: obstacle 'ball' has no waypoint");
  EXPECT_EQ(
      message([](MovingObstacle& o) { o.waypoints[1].time = 0.0; }),
      "World: obstacle 'ball' has a waypoint, number 2, that is not later than the one before");
  EXPECT_EQ(message([](MovingObstacle& o) { o.waypoints[1].time = NAN; }),
            "World: obstacle 'ball' has a waypoint, number 2, whose time is not finite");
  EXPECT_EQ(message([](MovingObstacle& o) { o.waypoints[0].world_from_body.linear() *= 2; }),
            "World: obstacle 'ball' has a waypoint, number 1, whose pose is no finite rigid "
            "transform");
  EXPECT_EQ(message([](MovingObstacle& o) {
              o.parts[0].shape = makePlane({0, 0, 1}, 0);
            }),
            "World: obstacle 'ball' has a plane or a half-space, which cannot move");
  EXPECT_EQ(message([](MovingObstacle& o) { o.parts[0].body_from_shape.translation().x() = NAN; }),
            "World: obstacle 'ball' has a part whose pose is no finite rigid transform");
  good.name = "hand";
  world.add(good);
  EXPECT_EQ(messageOf([&] { Checker(parseArm(armUrdf({})), "all", shared(world)); }),
            "Checker: the world has a body 'hand', and so has the robot");
}

TEST(MovingObstacle, IsSomewhereAtEveryTime) {
  const World world = movingWorld();
  const MovingObstacle& bar = *world.findObstacle("bar");
  EXPECT_TRUE(bar.poseAt(-1.0).isApprox(bar.waypoints[0].world_from_body));
  EXPECT_TRUE(bar.poseAt(2.0).isApprox(bar.waypoints[0].world_from_body));
  EXPECT_TRUE(bar.poseAt(9.0).isApprox(bar.waypoints[1].world_from_body));
  const Eigen::Isometry3d middle =
      at(-0.5, 0.0, 0.6) * Eigen::AngleAxisd(1.25, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(bar.poseAt(3.5).isApprox(middle, 1e-12));
  const MovingObstacle& ball = *world.findObstacle("ball");
  EXPECT_TRUE(ball.poseAt(4.0).translation().isApprox(kStart + 2.0 / 3.0 * kWay, 1e-12));
}

}  // namespace
}  // namespace swept
