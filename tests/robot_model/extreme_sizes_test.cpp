// SPDX-License-Identifier: BSD-3-Clause
// Lengths whose squares are no numbers any more. Of 1e20 m a square overflows in the lanes, of
// 1e155 m in double: then a body as large was infinitely far away, and free. Of 1e-162 m it is
// rounded by half of itself, and balls that overlapped were apart.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "version_arms.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::at;

/// A ball that slides along x; two such slides, one upon the other, if `twice`.
std::shared_ptr<const Robot> slide(double radius, double limit, bool twice = false) {
  std::ostringstream text;
  text.precision(17);
  const auto joint = [&](const std::string& name, const std::string& on, const std::string& what) {
    text << "<joint name='" << name << "' type='prismatic'><parent link='" << on
         << "'/><child link='" << what << "'/><axis xyz='1 0 0'/><limit lower='" << -limit
         << "' upper='" << limit << "' effort='1' velocity='1'/></joint>";
  };
  text << "<robot name='r'><link name='base'/><link name='ball'><collision><geometry>"
       << "<sphere radius='" << radius << "'/></geometry></collision></link>";
  if (twice) {
    text << "<link name='sled'/>";
    joint("first", "base", "sled");
  }
  joint("x", twice ? "sled" : "base", "ball");
  text << "</robot>";
  return Robot::parse(text.str(), "r.urdf");
}

Checker checkerIn(const std::shared_ptr<const Robot>& robot, World world) {
  CheckerOptions options;
  options.maxIntervals = 200;
  return {robot, "all", std::make_shared<const World>(std::move(world)), options};
}

void expectNotFree(const Checker& checker, const std::vector<double>& q) {
  Workspace workspace(checker);
  EXPECT_EQ(checker.checkedPairs().size(), 1u);
  EXPECT_NE(checker.checkState(q, workspace), Verdict::Free);
  EXPECT_NE(checker.reportState(q, workspace).verdict, Verdict::Free);
  EXPECT_EQ(checker.clearance(q, workspace), 0.0);
  std::vector<double> from = q;
  from.front() -= 1e-3;
  for (const MotionQuery query : {MotionQuery::VerdictOnly, MotionQuery::FirstContact}) {
    EXPECT_NE(checker.certifyMotion(q, q, workspace, query).verdict, Verdict::Free);
    EXPECT_NE(checker.certifyMotion(from, q, workspace, query).verdict, Verdict::Free);
  }
  EXPECT_EQ(checker.motionClearance(from, q, 1e-3, workspace).lower, 0.0);
  EXPECT_LE(checker.signedClearance(q, workspace).lower, 0.0);
}

/// Bodies that hold all that is within 1.2 times `far` of their middle.
std::vector<Shape> giants(double far) {
  const double size = 1.5 * far;
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(i % 2 == 0 ? size : -size, i / 2 % 2 == 0 ? size : -size,
                         i / 4 == 0 ? size : -size);
  return {makeSphere(size),
          makeBox({2.0 * size, 2.0 * size, 2.0 * size}),
          makeCapsule(size, size),
          makeCylinder(size, 2.0 * size),
          makeCone(10.0 * size, 4.0 * size),
          makeEllipsoid({size, 2.0 * size, 3.0 * size}),
          ConvexHull::of(corners),
          makeHalfSpace({1.0, 0.0, 0.0}, size)};
}

TEST(ExtremeSizes, NothingIsFreeInsideAGiant) {
  for (const double far : {1e15, 1e19, 1e20, 1e25, 1e37, 3e38, 1e60, 1e153, 1e155, 1e200, 1e300}) {
    std::size_t which = 0;
    for (const Shape& shape : giants(far)) {
      SCOPED_TRACE(testing::Message() << "shape " << which++ << ", " << far << " m");
      for (const Vector3d& towards : {Vector3d(1, 0, 0), Vector3d(0, 0, 1), Vector3d(-1, 0, 0)}) {
        World world;
        world.add("giant", shape, at(far * towards.x(), far * towards.y(), far * towards.z()));
        expectNotFree(checkerIn(slide(0.05, 1.0), std::move(world)), {0.1});
      }
    }
  }
}

TEST(ExtremeSizes, NothingIsFreeOfALinkThatIsAGiant) {
  for (const double size : {1e20, 1e100, 1e155, 1e160, 1e200}) {
    SCOPED_TRACE(size);
    World world;
    world.add("giant", makeSphere(size), at(1.5 * size, 0.0, 0.0));
    expectNotFree(checkerIn(slide(size, 1.0), std::move(world)), {0.1});
  }
}

TEST(ExtremeSizes, WhatIsFarIsNotOutOfReach) {
  for (const double far : {1e100, 1e153, 1e155, 1e200, 1e300}) {
    for (const double size : {0.1, 0.1 * far}) {
      SCOPED_TRACE(testing::Message() << far << " " << size);
      World world;
      world.add("ball", makeSphere(size), at(far, 0.0, 0.0));
      expectNotFree(checkerIn(slide(0.05, 1e305), std::move(world)), {far});
    }
  }
}

/// So many bodies that they are looked up by their boxes. Limits that add up to more than there is
/// made a box no box at all, which met nothing.
TEST(ExtremeSizes, NothingIsFreeAmongManyWhereTheReachOverflows) {
  World world;
  for (int i = 0; i < 60; ++i)
    world.add("ball" + std::to_string(i), makeSphere(0.1), at(0.0, 0.0, 0.5 * i));
  const Checker checker = checkerIn(slide(0.05, 1.5e308, true), std::move(world));
  Workspace workspace(checker);
  const std::vector<double> q{0.0, 0.0}, from{-0.5, 0.0};
  EXPECT_NE(checker.checkState(q, workspace), Verdict::Free);
  EXPECT_NE(checker.certifyMotion(from, q, workspace).verdict, Verdict::Free);
  EXPECT_NE(checker.reportState(q, workspace).verdict, Verdict::Free);
  EXPECT_EQ(checker.clearance(q, workspace), 0.0);
  EXPECT_EQ(checker.motionClearance(from, q, 1e-3, workspace).lower, 0.0);
}

TEST(ExtremeSizes, NothingIsFreeThatOverlapsByLessThanASquareTells) {
  for (const double radius : {1e-150, 1e-160, 1e-162, 1e-170, 1e-300}) {
    for (const double apart : {0.0, 1.2, 1.6, 1.9, 2.0}) {
      SCOPED_TRACE(testing::Message() << radius << " " << apart);
      World world;
      world.add("ball", makeSphere(radius), at(0.0, 0.0, apart * radius));
      expectNotFree(checkerIn(slide(radius, 1.0), std::move(world)), {0.0});
    }
  }
}

/// From far behind a ball to far before it.
TEST(ExtremeSizes, NothingIsFreeThatPassesAtAnySpeed) {
  for (const double far : {1e19, 1e100, 1e155, 1e200, 8e307}) {
    SCOPED_TRACE(far);
    World world;
    world.add("ball", makeSphere(0.1), at(0.0, 0.0, 0.0));
    const Checker checker = checkerIn(slide(0.05, 1e308), std::move(world));
    Workspace workspace(checker);
    const std::vector<double> from{-far}, to{far};
    EXPECT_NE(checker.certifyMotion(from, to, workspace).verdict, Verdict::Free);
    EXPECT_EQ(checker.motionClearance(from, to, 1e-3, workspace).lower, 0.0);
  }
}

}  // namespace
}  // namespace swept
