// SPDX-License-Identifier: BSD-3-Clause
// One pair within rounding of the margin leaves a state undecided, whatever is looked at after it.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "swept/robot_model/checker.hpp"

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using swept::Checker;
using swept::CheckerOptions;
using swept::Verdict;
using swept::Workspace;
using swept::World;

/// A ball of radius 1/8 m on a slide along x.
constexpr const char* kBall = R"(<robot name="ball">
  <link name="base"/>
  <link name="ball"><collision><geometry><sphere radius="0.125"/></geometry></collision></link>
  <joint name="slide" type="prismatic"><parent link="base"/><child link="ball"/>
    <axis xyz="1 0 0"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint>
</robot>)";

/// m, between two balls; numbers of few bits, so that the gap is exact.
constexpr double kGap = 0.25;
/// m. Single precision does not see it, double precision does.
constexpr double kMore = 1e-9;

/// Balls around the state 0.5, all but the one at `near` farther than the margin by kMore.
std::shared_ptr<const World> ballsAround(std::size_t near) {
  std::vector<Vector3d> towards;
  for (const Vector3d& axis :
       {Vector3d(Vector3d::UnitX()), Vector3d(Vector3d::UnitY()), Vector3d(Vector3d::UnitZ())}) {
    towards.emplace_back(axis);
    towards.emplace_back(-axis);
  }
  auto world = std::make_shared<World>();
  for (std::size_t i = 0; i < towards.size(); ++i) {
    const double distance = 0.125 + kGap + 0.125 + (i == near ? 0.0 : kMore);
    Isometry3d pose = Isometry3d::Identity();
    pose.translation() = Vector3d(0.5, 0.0, 0.0) + distance * towards[i];
    world->add("ball" + std::to_string(i), swept::Sphere{0.125}, pose);
  }
  return world;
}

Checker checkerAmong(std::size_t near) {
  CheckerOptions options;
  options.margin = kGap * (1.0 - 1e-15);
  return Checker(swept::Robot::parse(kBall, "ball.urdf"), "all", ballsAround(near), options);
}

TEST(UndecidedStates, OnePairWithinRoundingOfTheMarginIsEnough) {
  const std::vector<double> q{0.5};
  for (std::size_t near = 0; near < 6; ++near) {
    const Checker checker = checkerAmong(near);
    Workspace workspace(checker);
    EXPECT_EQ(checker.checkState(q, workspace), Verdict::Undecided) << near;
    EXPECT_EQ(checker.reportState(q, workspace).verdict, Verdict::Undecided) << near;
    EXPECT_NE(checker.certifyMotion(q, q, workspace).verdict, Verdict::Free) << near;
  }
}

TEST(UndecidedStates, AllPairsBeyondRoundingAreFree) {
  const std::vector<double> q{0.5};
  const Checker checker = checkerAmong(6);
  Workspace workspace(checker);
  EXPECT_EQ(checker.checkState(q, workspace), Verdict::Free);
  EXPECT_EQ(checker.reportState(q, workspace).verdict, Verdict::Free);
}

}  // namespace
