// SPDX-License-Identifier: BSD-3-Clause
// The signed clearance of a state and its derivatives, against closed forms and differences.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "swept/robot_model/checker.hpp"

namespace {

using namespace swept;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A ball of 0.1 m on three slides along x, y and z.
constexpr const char* kGantry = R"(<robot name="gantry">
  <link name="frame"/><link name="beam"/><link name="trolley"/>
  <link name="ball"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="x" type="prismatic"><parent link="frame"/><child link="beam"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="y" type="prismatic"><parent link="beam"/><child link="trolley"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="z" type="prismatic"><parent link="trolley"/><child link="ball"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>)";

/// Every kind of joint that has values, with convex links.
constexpr const char* kRover = R"(<robot name="rover">
  <link name="ground"/><link name="cart"/>
  <link name="mast"><collision><origin xyz="0 0 0.2"/>
    <geometry><box size="0.1 0.08 0.4"/></geometry></collision></link>
  <link name="arm"><collision><origin xyz="0.2 0 0" rpy="0 1.57 0"/>
    <geometry><cylinder radius="0.03" length="0.4"/></geometry></collision></link>
  <link name="flag"><collision><origin xyz="0 0 0.1"/>
    <geometry><box size="0.02 0.1 0.2"/></geometry></collision></link>
  <link name="kite"><collision><origin xyz="0.1 0 0"/>
    <geometry><box size="0.3 0.2 0.05"/></geometry></collision></link>
  <joint name="drive" type="planar"><parent link="ground"/><child link="cart"/><axis xyz="0 0 1"/></joint>
  <joint name="turn" type="continuous"><parent link="cart"/><child link="mast"/><axis xyz="0 0 1"/></joint>
  <joint name="lift" type="revolute"><parent link="mast"/><child link="arm"/>
    <origin xyz="0 0 0.42"/><axis xyz="0 1 0"/><limit lower="-1.5" upper="1.5" effort="1" velocity="1"/></joint>
  <joint name="wave" type="revolute"><parent link="arm"/><child link="flag"/><origin xyz="0.4 0 0.05"/>
    <axis xyz="1 0 0"/><limit lower="-1.5" upper="1.5" effort="1" velocity="1"/>
    <mimic joint="lift" multiplier="-0.5"/></joint>
  <joint name="fly" type="floating"><parent link="ground"/><child link="kite"/></joint>
</robot>)";

Checker makeChecker(const char* urdf, std::shared_ptr<const World> world) {
  return {Robot::parse(urdf, "test.urdf"), "all", std::move(world)};
}

Isometry3d at(const Vector3d& place) {
  Isometry3d pose = Isometry3d::Identity();
  pose.translation() = place;
  return pose;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vector3d vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  /// drive (x, y, theta), turn, lift, fly (x, y, z, quaternion)
  std::vector<double> rover() {
    const Vector3d kite = vector(0.7);
    const Eigen::Quaterniond turned(Eigen::AngleAxisd(uniform(0.0, 3.0), vector(1.0).normalized()));
    return {uniform(-0.5, 0.5), uniform(-0.5, 0.5), uniform(-3.0, 3.0), uniform(-3.0, 3.0),
            uniform(-1.4, 1.4), kite.x(),           kite.y(),           kite.z(),
            turned.x(),         turned.y(),         turned.z(),         turned.w()};
  }

 private:
  std::mt19937 engine_;
};

TEST(SignedClearance, OfABallIsThatOfItsCentre) {
  auto world = std::make_shared<World>();
  const Vector3d ball(0.3, -0.2, 0.1), box(-0.4, 0.3, 0.0), half(0.3, 0.2, 0.25);
  world->add("ball", makeSphere(0.25), at(ball));
  world->add("box", makeBox(2.0 * half), at(box));
  const Checker checker = makeChecker(kGantry, world);
  Workspace workspace(checker);
  Random random(1);
  int overlaps = 0, deep = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vector3d p = random.vector(0.99);
    const double toBall = (p - ball).norm() - 0.35;
    const Vector3d beyond = (p - box).cwiseAbs() - half;
    const double toBox = beyond.cwiseMax(0.0).norm() + std::min(0.0, beyond.maxCoeff()) - 0.1;
    const double truth = std::min(toBall, toBox);
    const std::vector<double> q{p.x(), p.y(), p.z()};
    Vector3d gradient;
    const SignedClearance found = checker.signedClearance(q, workspace, {gradient.data(), 3});
    ASSERT_LE(found.lower, truth + 1e-12);
    ASSERT_GE(found.upper, truth - 1e-12);
    ASSERT_LE(found.upper - found.lower, 1e-7);
    overlaps += truth < 0.0;
    deep += truth < -0.1;
    if (std::abs(toBall - toBox) < 1e-6 || std::abs(truth) < 1e-6) continue;
    if (toBall < toBox) {
      ASSERT_LT((gradient - (p - ball).normalized()).norm(), 1e-5);
    } else {
      ASSERT_NEAR(gradient.norm(), 1.0, 1e-6);
    }
  }
  EXPECT_GT(overlaps, 500);
  EXPECT_GT(deep, 150);
}

/// The sign says what the verdict does, the value of what is free what clearance() does, and the
/// derivatives are those of the value wherever this is smooth.
TEST(SignedClearance, AgreesWithVerdictsAndItsOwnDifferences) {
  Random random(2);
  int negative = 0, positive = 0, smooth = 0;
  for (int scene = 0; scene < 6; ++scene) {
    auto world = std::make_shared<World>();
    for (int i = 0; i < 4; ++i) {
      Isometry3d pose = at(random.vector(0.8));
      pose.linear() =
          Eigen::AngleAxisd(random.uniform(0, 3), random.vector(1).normalized()).toRotationMatrix();
      world->add("box" + std::to_string(i),
                 makeBox(random.vector(0.2).cwiseAbs() * 2.0 + Vector3d::Constant(0.05)), pose);
      world->add("ball" + std::to_string(i), makeSphere(random.uniform(0.05, 0.2)),
                 at(random.vector(0.8)));
    }
    const Checker checker = makeChecker(kRover, world);
    Workspace workspace(checker);
    const auto n = static_cast<std::size_t>(checker.dimension());
    for (int i = 0; i < 150; ++i) {
      const std::vector<double> q = random.rover();
      std::vector<double> gradient(n);
      const SignedClearance found = checker.signedClearance(q, workspace, gradient);
      ASSERT_LE(found.lower, found.upper);
      const Verdict verdict = checker.checkState(q, workspace);
      if (found.upper < -1e-9) {
        ASSERT_EQ(verdict, Verdict::Collision);
        ASSERT_EQ(checker.clearance(q, workspace), 0.0);
        ++negative;
      } else if (found.lower > 0.0) {
        ASSERT_EQ(verdict, Verdict::Free);
        ASSERT_NEAR(checker.clearance(q, workspace), found.lower, 1e-8);
        ++positive;
      }
      std::vector<double> direction(n);
      for (double& d : direction) d = random.uniform(-1.0, 1.0);
      const auto valueAt = [&](double step) {
        std::vector<double> there = q;
        for (std::size_t k = 0; k < n; ++k) there[k] += step * direction[k];
        return checker.signedClearance(there, workspace).upper;
      };
      const double h = 1e-5;
      const double left = (found.upper - valueAt(-h)) / h, right = (valueAt(h) - found.upper) / h;
      if (std::abs(left - right) > 1e-3) continue;  // another pair, or another feature
      double expected = 0.0;
      for (std::size_t k = 0; k < n; ++k) expected += gradient[k] * direction[k];
      ASSERT_NEAR(0.5 * (left + right), expected, 2e-3) << "scene " << scene << ", state " << i;
      ++smooth;
    }
  }
  EXPECT_GT(negative, 150);
  EXPECT_GT(positive, 150);
  EXPECT_GT(smooth, 700);
}

TEST(SignedClearance, WithoutPairsIsInfinite) {
  const Checker checker = makeChecker(kGantry, std::make_shared<World>());
  Workspace workspace(checker);
  std::vector<double> gradient(3, 7.0);
  const SignedClearance found =
      checker.signedClearance(std::vector<double>{0.1, 0.2, 0.3}, workspace, gradient);
  EXPECT_EQ(found.lower, kInfinity);
  EXPECT_EQ(found.upper, kInfinity);
  EXPECT_EQ(gradient, std::vector<double>(3, 0.0));
}

TEST(SignedClearance, OfWhatIsNoStateIsUnknown) {
  auto world = std::make_shared<World>();
  world->add("ball", makeSphere(0.25), at(Vector3d(0.5, 0.5, 0.5)));
  const Checker checker = makeChecker(kGantry, world);
  Workspace workspace(checker);
  for (const double bad : {std::nan(""), kInfinity, 1.5}) {
    std::vector<double> gradient(3, 7.0);
    const SignedClearance found =
        checker.signedClearance(std::vector<double>{0.0, bad, 0.0}, workspace, gradient);
    EXPECT_EQ(found.lower, -kInfinity);
    EXPECT_EQ(found.upper, kInfinity);
    EXPECT_EQ(gradient, std::vector<double>(3, 0.0));
  }
  std::vector<double> tooLong(4);
  const std::vector<double> q(3, 0.0);
  EXPECT_THROW(checker.signedClearance(q, workspace, tooLong), std::invalid_argument);
  EXPECT_THROW(checker.signedClearance(tooLong, workspace), std::invalid_argument);
}

/// At the ends of their limits joints can go one way only.
TEST(SignedClearance, HasDerivativesAtTheLimits) {
  auto world = std::make_shared<World>();
  world->add("ball", makeSphere(0.25), at(Vector3d(0.2, 0.0, 0.0)));
  const Checker checker = makeChecker(kGantry, world);
  Workspace workspace(checker);
  for (const double end : {-1.0, 1.0}) {
    Vector3d gradient;
    checker.signedClearance(std::vector<double>{end, 0.0, 0.0}, workspace, {gradient.data(), 3});
    EXPECT_LT((gradient - Vector3d(end, 0.0, 0.0)).norm(), 1e-9);
  }
}

}  // namespace
