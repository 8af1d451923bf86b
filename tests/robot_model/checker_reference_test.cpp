// SPDX-License-Identifier: BSD-3-Clause
// A reference that no pose can be made of is refused. A quaternion of zeros was taken for one that
// turns nothing: verdicts held for a pose that nobody had named.
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "swept/robot_model/inverse_kinematics.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/self_filter.hpp"
#include "version_arms.hpp"

namespace swept {
namespace {

using test::messageOf;

/// Two floating joints, and a group that moves neither.
std::shared_ptr<const Robot> twoKites() {
  return Robot::parse(R"(<robot name="kites"><link name="base"/><link name="a"/><link name="b"/>
  <joint name="j" type="revolute"><parent link="b"/><child link="tip"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint><link name="tip"/>
  <joint name="first" type="floating"><parent link="base"/><child link="a"/></joint>
  <joint name="second" type="floating"><parent link="a"/><child link="b"/></joint></robot>)",
                      "kites.urdf",
                      R"(<robot name="kites"><group name="tip"><joint name="j"/></group></robot>)",
                      "kites.srdf");
}

std::string refusal(const Eigen::VectorXd& reference) {
  CheckerOptions options;
  options.reference = reference;
  return messageOf([&] { Checker(twoKites(), "tip", std::make_shared<World>(), options); });
}

Eigen::VectorXd withQuaternion(const Robot& robot, const std::string& joint,
                               const Eigen::Vector4d& quaternion) {
  Eigen::VectorXd state = robot.defaultState();
  for (const Joint& candidate : robot.joints())
    if (candidate.name == joint) state.segment<4>(candidate.firstVariable + 3) = quaternion;
  return state;
}

TEST(CheckerReference, AQuaternionNeedsADirection) {
  const auto robot = twoKites();
  const auto given = [&](const std::string& joint, const Eigen::Vector4d& quaternion) {
    return refusal(withQuaternion(*robot, joint, quaternion));
  };
  const std::string message = "the quaternion of joint 'second' has no direction";
  EXPECT_EQ(given("second", Eigen::Vector4d::Zero()), "Checker: " + message);
  EXPECT_EQ(given("second", {0.0, 5e-7, 0.0, 0.0}), "Checker: " + message);
  EXPECT_EQ(refusal(Eigen::VectorXd::Zero(robot->defaultState().size())),
            "Checker: the quaternion of joint 'first' has no direction");
  EXPECT_EQ(given("second", {0.0, 2e-6, 0.0, 0.0}), "");
  EXPECT_EQ(given("second", {0.0, 0.0, 3.0, 4.0}), "");
  // The words of all that takes a state of the whole robot.
  const Eigen::VectorXd state = withQuaternion(*robot, "second", Eigen::Vector4d::Zero());
  EXPECT_EQ(messageOf([&] { withoutRobot({}, *robot, state, 0.0); }), "withoutRobot: " + message);
  const std::vector<double> q{0.0};
  EXPECT_EQ(messageOf([&] { LinkMotion(*robot, "tip", "tip", q, q, state); }),
            "LinkMotion: " + message);
  EXPECT_EQ(messageOf([&] { InverseKinematics(robot, "tip", "tip", state); }),
            "InverseKinematics: " + message);
}

TEST(CheckerReference, AQuaternionIsFinite) {
  const auto robot = twoKites();
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(refusal(withQuaternion(*robot, "second", {value, 0.0, 0.0, 1.0})),
              "Checker: 'second/rot_x' of the reference is not finite");
  }
}

}  // namespace
}  // namespace swept
