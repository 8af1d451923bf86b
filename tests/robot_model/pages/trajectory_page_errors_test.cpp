// SPDX-License-Identifier: BSD-3-Clause
// What a page of a trajectory refuses.
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "slide_page.hpp"

namespace swept {
namespace {

using test::dataOf;
using test::refusal;
using test::rideTo;
using test::slide;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(TrajectoryPageErrorsTest, WhatCannotBeShownIsRefusedAndChangesNothing) {
  Page page(slide());
  const PiecewisePolynomial ride = rideTo(1.3);
  std::vector<Eigen::MatrixXd> wide;
  wide.push_back(Eigen::MatrixXd::Zero(2, 2));
  const PiecewisePolynomial other({0, 1}, wide);
  const std::vector<std::vector<double>> crooked{{0.0}, {0.0, 1.0}}, endless{{kInfinity}};
  EXPECT_EQ(refusal([&] { page.addTrajectory("t", other); }),
            "'t' has 2 values; group 'all' has 1 variables");
  EXPECT_EQ(refusal([&] { page.addTrajectory("t", ride, {}, crooked); }),
            "'polyline of t' has 2 values; group 'all' has 1 variables");
  EXPECT_EQ(refusal([&] { page.addTrajectory("t", ride, {}, endless); }),
            "'polyline of t' has a value that is not finite");
  TrajectoryQuery query;
  query.clock = kInfinity;
  EXPECT_EQ(refusal([&] { page.addTrajectory("t", ride, query); }),
            "Checker: clock inf s must be a finite number");
  query = {};
  query.limits = RateLimits{.velocity = {1, 2}, .acceleration = {1}, .jerk = {1}};
  EXPECT_EQ(refusal([&] { page.addTrajectory("t", ride, query); }),
            "Checker: RateLimits::velocity of group 'all' has 1 values, not 2");
  EXPECT_EQ(refusal([&] { page.html(); }), "a page of nothing");
  page.addTrajectory("t", ride);
  EXPECT_EQ(refusal([&] { page.addState("s", std::vector<double>{0.0}); }),
            "a page has either states, or motions, or paths, or trajectories");
  Page states(slide());
  states.addState("s", std::vector<double>{0.0});
  EXPECT_EQ(refusal([&] { states.addTrajectory("t", ride); }),
            "a page has either states, or motions, or paths, or trajectories");
  EXPECT_EQ(dataOf(page)["motions"].size(), 1U);
  EXPECT_EQ(dataOf(states)["states"].size(), 1U);
}

TEST(TrajectoryPageErrorsTest, BesideMovingObstaclesStatesHaveTheirTime) {
  MovingObstacle cart{.name = "cart", .parts = {{Sphere{0.1}, Eigen::Isometry3d::Identity()}}};
  cart.waypoints.push_back({0.0, Eigen::Isometry3d(Eigen::Translation3d(9, 0, 0))});
  Page page(std::make_shared<const Checker>(slide()->withObstacle(cart)));
  EXPECT_EQ(refusal([&] { page.addState("s", std::vector<double>{0.0}); }),
            "'s' has 1 values; group 'all' has 1 variables, and the time of what moves comes after "
            "them");
  page.addTrajectory("t", rideTo(1.3), {.clock = 2.5});
  const auto data = dataOf(page);
  EXPECT_EQ(data["motions"][0]["curve"]["clock"], 2.5);
  EXPECT_EQ(data["bodies"].back()["name"], "cart");
  EXPECT_TRUE(data["bodies"].back().contains("motion"));
}

TEST(TrajectoryPageErrorsTest, OrientationsNeedADirection) {
  const auto robot = Robot::parse(
      "<robot name='r'><link name='a'/><link name='b'><collision><geometry><sphere radius='0.1'/>"
      "</geometry></collision></link><joint name='j' type='floating'><parent link='a'/><child "
      "link='b'/></joint></robot>",
      "r.urdf");
  std::vector<Eigen::MatrixXd> pieces;
  pieces.push_back(Eigen::MatrixXd::Zero(7, 4));
  pieces.push_back(Eigen::MatrixXd::Zero(7, 4));
  pieces.front().row(6).setOnes();
  pieces.back().row(6).setConstant(1.0 + 1e-10);
  Page page(std::make_shared<const Checker>(robot, "all", std::make_shared<const World>()));
  page.addTrajectory("rest", {{0, 1, 2}, pieces});
  for (Eigen::MatrixXd& piece : pieces) piece.row(6).setZero();
  EXPECT_EQ(refusal([&] {
              page.addTrajectory("nowhere", {{0, 1, 2}, pieces});
            }),
            "'nowhere': the quaternion of joint 'j' has no direction in piece 0");
}

}  // namespace
}  // namespace swept
