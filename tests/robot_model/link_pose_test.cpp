// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "swept/robot_model/link_motion.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;

/// A turntable, and on it, 0.5 m from its axis, a slide upwards; a second one mimics it.
std::shared_ptr<const Robot> turntable() {
  return Robot::parse(
      "<robot name='turntable'><link name='base'/><link name='table'/><link name='slide'/>"
      "<link name='double'/>"
      "<joint name='turn' type='revolute'><parent link='base'/><child link='table'/>"
      "<axis xyz='0 0 1'/><limit lower='-3' upper='3' effort='1' velocity='1'/></joint>"
      "<joint name='lift' type='prismatic'><parent link='table'/><child link='slide'/>"
      "<origin xyz='0.5 0 0'/><axis xyz='0 0 1'/>"
      "<limit lower='0' upper='2' effort='1' velocity='1'/></joint>"
      "<joint name='twice' type='prismatic'><parent link='table'/><child link='double'/>"
      "<axis xyz='0 0 1'/><limit lower='0' upper='4' effort='1' velocity='1'/>"
      "<mimic joint='lift' multiplier='2' offset='0.1'/></joint></robot>",
      "turntable.urdf",
      "<robot name='turntable'><group name='all'><joint name='turn'/><joint name='lift'/></group>"
      "<group name='turning'><joint name='turn'/></group></robot>",
      "turntable.srdf");
}

TEST(LinkPose, IsWhereTheJointsPutTheLink) {
  const auto robot = turntable();
  const std::vector<double> q{0.3, 0.7};
  const Eigen::Isometry3d pose = linkPose(*robot, "all", "slide", q);
  EXPECT_TRUE(
      pose.translation().isApprox(Vector3d(0.5 * std::cos(0.3), 0.5 * std::sin(0.3), 0.7), 1e-14));
  EXPECT_TRUE(
      pose.linear().isApprox(Eigen::AngleAxisd(0.3, Vector3d::UnitZ()).toRotationMatrix(), 1e-14));
  EXPECT_TRUE(linkPose(*robot, "all", "double", q)
                  .translation()
                  .isApprox(Vector3d(0.0, 0.0, 2.0 * 0.7 + 0.1), 1e-14));
  EXPECT_TRUE(linkPose(*robot, "all", "base", q).isApprox(Eigen::Isometry3d::Identity()));
}

TEST(LinkPose, TakesWhatTheGroupLeavesOutFromTheReference) {
  const auto robot = turntable();
  const std::vector<double> q{0.3};
  EXPECT_EQ(linkPose(*robot, "turning", "slide", q).translation().z(), 0.0);
  EXPECT_EQ(linkPose(*robot, "turning", "slide", q, Eigen::Vector2d(1.0, 0.7)).translation().z(),
            0.7);
}

TEST(LinkPose, RefusesWhatItDoesNotKnow) {
  const auto robot = turntable();
  EXPECT_THROW(linkPose(*robot, "all", "nose", std::vector<double>{0, 0}), std::invalid_argument);
  EXPECT_THROW(linkPose(*robot, "all", "slide", std::vector<double>{0}), std::invalid_argument);
}

}  // namespace
}  // namespace swept
