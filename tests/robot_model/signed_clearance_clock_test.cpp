// SPDX-License-Identifier: BSD-3-Clause
// Derivatives at values of a large magnitude, such as clocks that count from 1970: a step of 1e-6 s
// becomes 9.5e-7 s there by rounding (-0.95 m/s instead of -1), and nothing at 1e11 s.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "swept/robot_model/checker.hpp"

namespace swept {
namespace {

Eigen::Isometry3d at(double x) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0));
}

std::shared_ptr<const Robot> slide(const std::string& limits) {
  return Robot::parse(R"(<robot name="slide"><link name="base"/>
  <link name="ball"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
  <joint name="x" type="prismatic"><parent link="base"/><child link="ball"/><axis xyz="1 0 0"/>
    <limit )" + limits + R"( effort="1" velocity="1"/></joint></robot>)",
                      "slide.urdf");
}

/// The slide within 1 m, and a ball of its size that moves along the same axis.
Checker slideBesideCart(const std::vector<MovingObstacle::Waypoint>& waypoints) {
  MovingObstacle cart;
  cart.name = "cart";
  cart.parts.push_back({Sphere{0.05}, Eigen::Isometry3d::Identity()});
  cart.waypoints = waypoints;
  auto world = std::make_shared<World>();
  world->add(cart);
  return {slide(R"(lower="-1" upper="1")"), "all", world};
}

class Clock : public testing::TestWithParam<double> {};

TEST_P(Clock, RatesByTheTimeDoNotDependOnItsOrigin) {
  const double begin = GetParam();
  // Nearer by 1 m/s, then away by 2 m/s.
  const Checker checker =
      slideBesideCart({{begin, at(11.0)}, {begin + 10.0, at(1.0)}, {begin + 15.0, at(11.0)}});
  Workspace workspace(checker);
  std::array<double, 2> gradient{};
  checker.signedClearance(std::array{0.0, begin + 5.0}, workspace, gradient);
  EXPECT_NEAR(gradient[0], -1.0, 1e-8);
  EXPECT_NEAR(gradient[1], -1.0, 1e-8);
  // So soon before the turn that a step in proportion to the time would go past it.
  checker.signedClearance(std::array{0.0, begin + 9.875}, workspace, gradient);
  EXPECT_NEAR(gradient[1], -1.0, 1e-8);
  checker.signedClearance(std::array{0.0, begin + 12.0}, workspace, gradient);
  EXPECT_NEAR(gradient[1], 2.0, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(SignedClearance, Clock,
                         testing::Values(0.0, 1.7e9, -1.7e9, 1e11, 1e13, -1e13));

/// Obstacles stand where the rounding of the clock lets them: at 2^52 s, on whole seconds.
TEST(SignedClearanceClock, StepsAreNeverLostToRounding) {
  const double begin = 0x1p52;
  const Checker checker = slideBesideCart({{begin, at(1001.0)}, {begin + 1000.0, at(1.0)}});
  Workspace workspace(checker);
  std::array<double, 2> gradient{};
  checker.signedClearance(std::array{0.0, begin + 500.0}, workspace, gradient);
  EXPECT_NEAR(gradient[1], -1.0, 1e-8);
}

TEST(SignedClearanceClock, LimitsHoldForStepsOfAnySize) {
  auto world = std::make_shared<World>();
  world->add("wall", Sphere{0.05}, at(2.5e10));
  const Checker checker(slide(R"(lower="1e10" upper="3e10")"), "all", world);
  Workspace workspace(checker);
  std::array<double, 1> gradient{};
  for (const double x : {1e10, 2e10, 3e10}) {
    checker.signedClearance(std::array{x}, workspace, gradient);
    EXPECT_NEAR(gradient[0], x < 2.5e10 ? -1.0 : 1.0, 1e-8) << x;
  }
}

}  // namespace
}  // namespace swept
