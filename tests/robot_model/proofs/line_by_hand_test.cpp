// SPDX-License-Identifier: BSD-3-Clause
// What the checker of proofs shows of lines that a tool follows, where the truth is known by hand:
// it holds just above the deviation and is refused just below.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "verify/line.hpp"

namespace swept::verify {
namespace {

using Eigen::Vector3d;

constexpr double kNear = 1e-7;  // rad or m, from the limit
constexpr double kAny = 4.0;    // rad: any orientation

/// A link that turns about z, or slides along x.
Model oneJoint(JointKind kind) {
  Model model;
  model.links = {"arm"};
  Joint joint;
  joint.name = "joint";
  joint.kind = kind;
  joint.axis = kind == JointKind::Revolute ? Vector3d::UnitZ() : Vector3d::UnitX();
  joint.variable = 0;
  model.joints = {joint};
  model.jointOf = {0};
  model.variables = {{.name = "joint", .lower = -3.0, .upper = 3.0, .cyclic = false}};
  return model;
}

Eigen::Matrix3d aboutZ(double angle) {
  return Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
}

/// Of a tool 1 m beside the joint.
Line line(const Vector3d& begin, const Vector3d& way, double startsAt = 0.0, double turn = 0.0) {
  Line own;
  own.tool.link = 0;
  own.tool.link_from_frame.translation() = Vector3d::UnitX();
  own.begin.translation() = begin;
  own.begin.linear() = aboutZ(startsAt);
  own.way = way;
  own.turn = turn * Vector3d::UnitZ();
  own.shares = {0.0, 1.0};
  return own;
}

bool isShown(const Model& model, Line own, double position, double angle, double from, double to,
             std::size_t segment = 0) {
  own.position = position;
  own.angle = angle;
  const Motion motion(model, std::vector{from}, std::vector{to});
  try {
    checkLine(motion, own, segment, "here");
  } catch (const Refusal&) {
    return false;
  }
  return true;
}

/// The tool goes along an arc of 2 a, farthest from its chord in the middle.
TEST(LineByHand, PositionIsOfTheArcBesideItsChord) {
  const Model model = oneJoint(JointKind::Revolute);
  for (const double a : {0.05, 0.4, 1.2}) {
    const double off = 1.0 - std::cos(a);
    const Line own = line({std::cos(a), -std::sin(a), 0}, {0, 2.0 * std::sin(a), 0});
    EXPECT_TRUE(isShown(model, own, off + kNear, kAny, -a, a)) << a;
    EXPECT_FALSE(isShown(model, own, off - kNear, kAny, -a, a)) << a;
    EXPECT_TRUE(isShown(model, own, off + kNear, kAny, a, -a)) << "a line's point is the nearest";
  }
}

/// Beyond the end of a segment the distance is that from the end.
TEST(LineByHand, PositionBeyondAnEndIsFromThere) {
  const Model model = oneJoint(JointKind::Prismatic);
  const Line own = line({1, 0, 0}, {0.75, 0, 0});
  EXPECT_TRUE(isShown(model, own, 0.25 + kNear, kAny, 0.0, 1.0));
  EXPECT_FALSE(isShown(model, own, 0.25 - kNear, kAny, 0.0, 1.0));
  EXPECT_TRUE(isShown(model, own, kNear, kAny, 0.0, 0.75));
  EXPECT_FALSE(isShown(model, own, 0.5 - kNear, kAny, -0.5, 0.5));
  const Line stays = line({1, 0, 0}, {0, 0, 0});
  EXPECT_TRUE(isShown(model, stays, 0.5 + kNear, kAny, -0.5, 0.5));
  EXPECT_FALSE(isShown(model, stays, 0.5 - kNear, kAny, -0.5, 0.5));
}

/// The arm turns by 2 a; a line that turns by a part of it is behind by the rest at the end.
TEST(LineByHand, AngleIsFromTheTurningLine) {
  const Model model = oneJoint(JointKind::Revolute);
  for (const double a : {0.05, 0.4, 1.2}) {
    for (const double turn : {0.0, a, 2.0 * a, 2.5 * a}) {
      SCOPED_TRACE(testing::Message() << a << ' ' << turn);
      const Line own = line({std::cos(a), -std::sin(a), 0}, {0, 2.0 * std::sin(a), 0}, -a, turn);
      const double off = std::abs(2.0 * a - turn);
      EXPECT_TRUE(isShown(model, own, 9.0, off + kNear, -a, a));
      EXPECT_FALSE(off > 0.0 && isShown(model, own, 9.0, off - kNear, -a, a));
      // The other way round it begins where the line ends.
      const double back = std::max(2.0 * a, turn);
      EXPECT_TRUE(isShown(model, own, 9.0, back + kNear, a, -a));
      EXPECT_FALSE(isShown(model, own, 9.0, back - kNear, a, -a));
    }
  }
}

/// A chord has the part of the line between its shares, for its place and for its turn.
TEST(LineByHand, AChordHasItsPartOfTheLine) {
  const Model model = oneJoint(JointKind::Revolute);
  const double a = 0.3, off = 1.0 - std::cos(a);
  // From a quarter to the half, the line is as long as the chord of the arc, and turns by 2 a.
  const Vector3d way(0, 2.0 * std::sin(a), 0);
  Line own = line(Vector3d(std::cos(a), -std::sin(a), 0) - way, 4.0 * way, -a - 2.0 * a, 8.0 * a);
  own.first = 3;
  own.shares = {0.0, 0.25, 0.5, 1.0};
  EXPECT_TRUE(own.has(4));
  EXPECT_FALSE(own.has(2));
  EXPECT_FALSE(own.has(6));
  EXPECT_TRUE(isShown(model, own, off + kNear, kNear, -a, a, 4));
  EXPECT_FALSE(isShown(model, own, off - kNear, kNear, -a, a, 4));
  EXPECT_FALSE(isShown(model, own, off + kNear, 2.0 * a - kNear, -a, a, 3));
  EXPECT_FALSE(isShown(model, own, off + kNear, kAny, -a, a, 5));
}

/// What is no number shows nothing.
TEST(LineByHand, OfHugeNumbersNothingIsShown) {
  const Model model = oneJoint(JointKind::Prismatic);
  Line own = line({1, 0, 0}, {1, 0, 0});
  own.tool.link_from_frame.translation().x() = 1e40;
  EXPECT_FALSE(isShown(model, own, 1e200, kAny, 0.0, 1.0));
}

}  // namespace
}  // namespace swept::verify
