// SPDX-License-Identifier: BSD-3-Clause
// Tubes around states and curves of robots whose tubes are known by formulas; and what they cannot
// be.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "../core/split_mix.hpp"
#include "../message_of.hpp"
#include "../urdf_text.hpp"
#include "model_robots.hpp"
#include "sliding_cube.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {
namespace {

using test::messageOf;

TrackingTolerance all(double rotation, double translation) {
  TrackingTolerance tracking;
  tracking.rotation = rotation;
  tracking.translation = translation;
  return tracking;
}

std::shared_ptr<const World> boxAt(const Eigen::Vector3d& place) {
  auto world = std::make_shared<World>();
  world->add(WorldBody{
      .name = "box",
      .parts = {{makeBox({0.1, 0.1, 0.1}), Eigen::Isometry3d(Eigen::Translation3d(place))}}});
  return world;
}

PiecewisePolynomial staysAt(const std::vector<double>& q) {
  Eigen::MatrixXd piece(static_cast<Eigen::Index>(q.size()), 3);
  piece.colwise() = Eigen::Map<const Eigen::VectorXd>(q.data(), piece.rows());
  return {{0.0, 1.0}, {piece}};
}

/// The same of a state, a motion and a curve that stay.
Verdict verdictAt(const Checker& checker, const std::vector<double>& q) {
  Workspace workspace(checker);
  const Verdict state = checker.checkState(q, workspace);
  EXPECT_EQ(checker.certifyMotion(q, q, workspace).verdict, state);
  EXPECT_EQ(checker.certifyTrajectory(staysAt(q), workspace).verdict, state);
  EXPECT_EQ(checker.reportState(q, workspace).verdict, state);
  return state;
}

TEST(TrackingTolerance, OfAJointThatSlides) {
  CheckerOptions options;
  options.tracking = all(0.0, 0.05);
  const Checker checker(test::slidingCube(), "all", test::worldWithCube(), options);
  // Both x and z are off by as much: the corner of the cube comes near the block's edge.
  EXPECT_EQ(verdictAt(checker, {0.252, 0.0}), Verdict::Free);
  EXPECT_EQ(verdictAt(checker, {0.249, 0.0}), Verdict::Collision);
  EXPECT_EQ(verdictAt(checker, {0.252, 0.252}), Verdict::Free);
  EXPECT_EQ(verdictAt(checker, {0.249, 0.249}), Verdict::Collision);
  EXPECT_EQ(verdictAt(checker, {0.252, 0.249}), Verdict::Free);
  Workspace workspace(checker);
  const StateReport report = checker.reportState(std::vector{0.249, 0.0}, workspace);
  ASSERT_EQ(report.contacts.size(), 1U);
  EXPECT_NEAR(report.contacts[0].configuration.at(0), 0.199, 1e-12);
  EXPECT_NEAR(report.clearance, 0.049, 1e-6);
}

/// The limit is 3 m: the tube ends there.
TEST(TrackingTolerance, DoesNotLeaveTheLimitsOfWhatSlides) {
  CheckerOptions options;
  options.tracking = all(0.0, 0.05);
  const Checker beyond(test::slidingCube(), "all", boxAt({3.17, 0.0, 0.0}), options);
  EXPECT_NE(verdictAt(beyond, {3.0, 0.0}), Verdict::Collision);
  EXPECT_EQ(verdictAt(beyond, {2.9, 0.0}), Verdict::Free);
  const Checker before(test::slidingCube(), "all", boxAt({2.83, 0.0, 0.0}), options);
  Workspace workspace(before);
  EXPECT_EQ(verdictAt(before, {3.0, 0.0}), Verdict::Collision);
  EXPECT_EQ(Checker(test::slidingCube(), "all", boxAt({2.78, 0.0, 0.0}), options)
                .checkState({3.0, 0.0}, workspace),
            Verdict::Free);
}

/// An arm of 1 m with a ball of 0.1 m at its end, and one that turns twice as far the other way.
std::shared_ptr<const Robot> mirrored() {
  const std::string ball =
      "<collision><origin xyz='1 0 0'/><geometry><sphere radius='0.1'/></geometry></collision>";
  return Robot::parse(
      "<robot name='mirrored'><link name='base'/><link name='leader'>" + ball +
          "</link><link name='follower'>" + ball + "</link><link name='other'/>" +
          test::joint("lead", "revolute", "base", "leader", test::limited("0 0 1", -2.0, 2.0)) +
          test::joint("follow", "revolute", "base", "follower",
                      "<origin xyz='0 0 1'/>" + test::limited("0 0 1", -4.0, 4.0) +
                          "<mimic joint='lead' multiplier='-2' offset='0.5'/>") +
          test::joint("aside", "revolute", "base", "other", test::limited("0 0 1", -2.0, 2.0)) +
          "</robot>",
      "mirrored.urdf",
      "<robot name='mirrored'><group name='arms'><joint name='lead'/></group></robot>",
      "mirrored.srdf");
}

TEST(TrackingTolerance, OfAMasterIsThatOfItsFollowers) {
  CheckerOptions options;
  options.tracking.joints["lead"].rotation = 0.1;
  // The follower is at 0.5 - 2 q, and off that by 0.2; its ball is at z = 1.
  const auto follower = [&](double angle) {
    const Checker checker(mirrored(), "arms",
                          boxAt({1.15 * std::cos(angle), 1.15 * std::sin(angle), 1.0}), options);
    return verdictAt(checker, {0.0});
  };
  EXPECT_EQ(follower(0.5), Verdict::Collision);
  EXPECT_EQ(follower(0.7), Verdict::Collision);
  EXPECT_EQ(follower(0.3), Verdict::Collision);
  EXPECT_EQ(follower(0.95), Verdict::Free);
  EXPECT_EQ(follower(0.05), Verdict::Free);
  const auto leader = [&](double angle) {
    const Checker checker(mirrored(), "arms",
                          boxAt({1.15 * std::cos(angle), 1.15 * std::sin(angle), 0.0}), options);
    return verdictAt(checker, {0.0});
  };
  EXPECT_EQ(leader(0.1), Verdict::Collision);
  EXPECT_EQ(leader(0.3), Verdict::Free);
}

/// A tube of half a turn is a tube too.
TEST(TrackingTolerance, OfAnyWidth) {
  for (const double width : {1e-12, 1e-300, 3.0}) {
    CheckerOptions options;
    options.tracking = all(width, width);
    const auto verdict = [&](double angle) {
      const Checker checker(mirrored(), "arms",
                            boxAt({1.15 * std::cos(angle), 1.15 * std::sin(angle), 0.0}), options);
      return verdictAt(checker, {0.0});
    };
    EXPECT_EQ(verdict(0.0), Verdict::Collision) << width;
    // Contacts are sought at the ends of a tube alone.
    EXPECT_EQ(verdict(0.4), width < 1.0 ? Verdict::Free : Verdict::Undecided) << width;
    const Checker far(mirrored(), "arms", boxAt({1.0, 0.0, 3.0}), options);
    EXPECT_EQ(verdictAt(far, {0.0}), Verdict::Free) << width;
  }
}

/// What the tube of `turn` moves at the end of `slide` is beyond single precision.
TEST(TrackingTolerance, OfASlideWithoutEnd) {
  for (const char* end : {"1e3", "1e30", "1e60", "1e300"}) {
    const auto robot = Robot::parse(
        "<robot name='r'><link name='base'/><link name='arm'/><link name='ball'><collision>"
        "<geometry><sphere radius='0.1'/></geometry></collision></link>" +
            test::joint("turn", "revolute", "base", "arm", test::limited("0 0 1", -1.0, 1.0)) +
            test::joint("slide", "prismatic", "arm", "ball",
                        std::string("<axis xyz='1 0 0'/><limit lower='0' upper='") + end +
                            "' effort='1' velocity='1'/>") +
            "</robot>",
        "r.urdf");
    CheckerOptions options;
    options.tracking = all(0.01, 0.0);
    const Checker meets(robot, "all", boxAt({1.0, 0.0, 0.0}), options);
    EXPECT_EQ(verdictAt(meets, {0.0, 1.0}), Verdict::Collision) << end;
    const Checker keeps(robot, "all", boxAt({0.0, 1.0, 0.0}), options);
    EXPECT_EQ(verdictAt(keeps, {0.0, 1.0}), Verdict::Free) << end;
  }
}

/// The place of a planar base errs in a disc, that of a floating one in a ball.
TEST(TrackingTolerance, OfABaseThatDrives) {
  const auto robot = test::modelRobot("rook6_cart");
  CheckerOptions options;
  options.tracking = all(0.0, 0.05);
  const Checker plain(robot, "base", boxAt({0.0, 3.0, 0.2}));
  const Checker tube(robot, "base", boxAt({0.0, 3.0, 0.2}), options);
  Workspace workspace(plain), other(tube);
  // Where it touches, by bisection; then 5 cm less a little, in three directions of travel.
  for (const double x : {0.0, 0.01, -0.02}) {
    double free = 0.0;
    double meets = 3.0;
    while (meets - free > 1e-9) {
      const double middle = 0.5 * (free + meets);
      const bool apart = plain.checkState(std::vector{x, middle, 0.0}, workspace) == Verdict::Free;
      (apart ? free : meets) = middle;
    }
    EXPECT_EQ(verdictAt(tube, {x, free - 0.0505, 0.0}), Verdict::Free) << x;
    EXPECT_EQ(verdictAt(tube, {x, free - 0.0495, 0.0}), Verdict::Collision) << x;
  }
}

/// A planar joint lengthens the arm of the one that carries it without limits: only exact geometry
/// has a bound then.
TEST(TrackingTolerance, OfAPlanarJointThatAnotherCarries) {
  const auto robot = Robot::parse(
      "<robot name='plotter'><link name='base'/><link name='turned'/><link name='pen'><collision>"
      "<origin xyz='0.2 0 0'/><geometry><box size='0.2 0.1 0.1'/></geometry></collision></link>" +
          test::joint("turn", "revolute", "base", "turned", test::limited("0 0 1", -3.0, 3.0)) +
          test::joint("place", "planar", "turned", "pen", "<axis xyz='0 0 1'/>") + "</robot>",
      "plotter.urdf");
  CheckerOptions options;
  options.tracking = all(0.03, 0.02);
  const Checker tube(robot, "all", boxAt({2.0, 0.0, 0.0}), options);
  const Checker plain(robot, "all", boxAt({2.0, 0.0, 0.0}));
  Workspace workspace(tube), other(plain);
  test::SplitMix random(101);
  int free = 0, collision = 0, near = 0;
  for (int round = 0; round < 3000; ++round) {
    const double turn = random.uniform(-0.5, 0.5);
    const double along = random.uniform(1.3, 1.8);
    const std::vector<double> q{turn, along * std::cos(turn), -along * std::sin(turn),
                                random.uniform(-0.5, 0.5)};
    const Verdict verdict = tube.checkState(q, workspace);
    free += verdict == Verdict::Free ? 1 : 0;
    collision += verdict == Verdict::Collision ? 1 : 0;
    if (verdict != Verdict::Free) continue;
    near += plain.clearance(q, other) < 0.15 ? 1 : 0;
    for (int k = 0; k < 64; ++k) {
      const double way = random.uniform(0.0, 6.3);
      const std::vector<double> beside{q[0] + 0.03 * random.sign(), q[1] + 0.02 * std::cos(way),
                                       q[2] + 0.02 * std::sin(way), q[3] + 0.03 * random.sign()};
      ASSERT_NE(plain.checkState(beside, other), Verdict::Collision);
    }
  }
  EXPECT_GT(free, 600);
  EXPECT_GT(collision, 600);
  EXPECT_GT(near, 100);
}

TEST(TrackingTolerance, NamesWhatItCannotBe) {
  const auto robot = test::modelRobot("rook7");
  const auto of = [&](const TrackingTolerance& tracking, const std::string& group = "arm") {
    return messageOf([&] {
      CheckerOptions options;
      options.tracking = tracking;
      Checker(robot, group, std::make_shared<World>(), options);
    });
  };
  const auto joint = [](const std::string& name, double rotation, double translation) {
    TrackingTolerance tracking;
    tracking.joints[name] = {rotation, translation};
    return tracking;
  };
  const std::string finite = ", which must be a finite number that is not negative";
  EXPECT_EQ(of(all(0.01, 0.001)), "");
  EXPECT_EQ(of(all(-0.1, 0.0)),
            "Checker: tracking tolerance of all joints has rotation -0.1 rad" + finite);
  EXPECT_EQ(of(all(0.0, -1e-9)),
            "Checker: tracking tolerance of all joints has translation -1e-09 m" + finite);
  EXPECT_EQ(of(all(std::nan(""), 0.0)),
            "Checker: tracking tolerance of all joints has rotation nan rad" + finite);
  EXPECT_EQ(of(all(0.0, HUGE_VAL)),
            "Checker: tracking tolerance of all joints has translation inf m" + finite);
  EXPECT_EQ(of(joint("joint3", -0.5, 0.0)),
            "Checker: tracking tolerance of joint 'joint3' has rotation -0.5 rad" + finite);
  EXPECT_EQ(of(joint("joint3", 0.0, std::nan(""))),
            "Checker: tracking tolerance of joint 'joint3' has translation nan m" + finite);
  EXPECT_EQ(of(joint("joint9", 0.1, 0.0)),
            "Checker: tracking tolerance of joint 'joint9', which the robot does not have");
  EXPECT_EQ(of(joint("finger_joint", 0.0, 0.001)),
            "Checker: tracking tolerance of joint 'finger_joint', which group 'arm' does not move");
  EXPECT_EQ(of(joint("finger_mimic", 0.0, 0.001), "arm_with_gripper"),
            "Checker: tracking tolerance of joint 'finger_mimic', which follows joint "
            "'finger_joint': its tolerance follows, too");
  EXPECT_EQ(of(joint("finger_joint", 0.0, 0.001), "arm_with_gripper"), "");
}

}  // namespace
}  // namespace swept
