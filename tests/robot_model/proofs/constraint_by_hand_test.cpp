// SPDX-License-Identifier: BSD-3-Clause
// What the checker of proofs shows of constraints on arms of one or two joints, where the truth is
// known by hand: it holds just below the limit and is refused just beyond.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "verify/constraint.hpp"

namespace swept::verify {
namespace {

using Eigen::Vector3d;

constexpr double kNear = 1e-7;  // rad or m, from the limit

/// A wheel that turns about z of the model frame.
Model wheel(double tolerance = 0.0) {
  Model model;
  model.links = {"wheel"};
  Joint joint;
  joint.name = "axle";
  joint.kind = JointKind::Revolute;
  joint.axis = Vector3d::UnitZ();
  joint.variable = 0;
  joint.tolerance.rotation = tolerance;
  model.joints = {joint};
  model.jointOf = {0};
  model.variables = {{.name = "axle", .lower = -3.0, .upper = 3.0, .cyclic = false}};
  return model;
}

Frame at(int link, const Vector3d& place) {
  Frame frame{.link = link};
  frame.link_from_frame.translation() = place;
  return frame;
}

/// Whether it is shown from one angle to another.
template <typename What>
bool isShown(const Model& model, const What& what, const std::vector<double>& first,
             const std::vector<double>& last) {
  const Motion motion(model, first, last);
  try {
    checkConstraint(model, motion, {.name = "it", .text = {}, .what = what}, "here");
  } catch (const Refusal&) {
    return false;
  }
  return true;
}

template <typename What>
bool isShown(const Model& model, const What& what, double from, double to) {
  return isShown(model, what, std::vector{from}, std::vector{to});
}

/// x is at least this, seen from `reference`.
Regions beyond(const Frame& frame, const Frame& reference, double least) {
  Regions::Region box{.type = Regions::Type::Box, .size = {2.0 * (2.0 - least), 9.0, 9.0}};
  box.reference_from_region.translation().x() = 2.0;
  return {.frame = frame, .reference = reference, .regions = {box}};
}

/// A point stands still 1 m from the axle. Seen from the wheel, which turns from -0.5 to 0.5 rad,
/// it goes along an arc whose ends are at x = cos(0.5).
TEST(ConstraintByHand, APointSeenFromWhatTurns) {
  const Frame point = at(-1, Vector3d::UnitX()), turning = at(0, Vector3d::Zero());
  EXPECT_TRUE(isShown(wheel(), beyond(point, turning, std::cos(0.5) - kNear), -0.5, 0.5));
  EXPECT_FALSE(isShown(wheel(), beyond(point, turning, std::cos(0.5) + kNear), -0.5, 0.5));
}

/// A slider goes from 0.1 to 1.9 m beside the same wheel: seen from it, y = -r sin(angle). To first
/// order about the middle that would be 0.5 m at most.
TEST(ConstraintByHand, APointThatGoesOutwardsSeenFromWhatTurns) {
  Model model = wheel();
  model.links.emplace_back("slider");
  Joint slide;
  slide.name = "slide";
  slide.kind = JointKind::Prismatic;
  slide.child = 1;
  slide.variable = 1;
  model.joints.push_back(slide);
  model.jointOf.push_back(1);
  model.variables.push_back({.name = "slide", .lower = 0.0, .upper = 2.0, .cyclic = false});
  const auto within = [](double most) {
    const Regions::Region box{.type = Regions::Type::Box, .size = {9.0, 2.0 * most, 9.0}};
    return Regions{.frame = {.link = 1}, .reference = {.link = 0}, .regions = {box}};
  };
  const double most = 1.9 * std::sin(0.5);
  const std::vector<double> from{-0.5, 0.1}, to{0.5, 1.9};
  EXPECT_TRUE(isShown(model, within(most + kNear), from, to));
  EXPECT_FALSE(isShown(model, within(most - kNear), from, to));
}

/// The same of a point of the wheel, seen from outside; and where the wheel may be 0.1 rad off.
TEST(ConstraintByHand, APointThatTurns) {
  const Frame point = at(0, Vector3d::UnitX()), still = at(-1, Vector3d::Zero());
  for (const double off : {0.0, 0.1}) {
    const double least = std::cos(0.5 + off);
    // To first order, what the wheel is off by is known; to second, bounded: (0.1 rad)^2 / 2.
    const double loss = off * off;
    EXPECT_TRUE(isShown(wheel(off), beyond(point, still, least - loss - kNear), -0.5, 0.5));
    EXPECT_FALSE(isShown(wheel(off), beyond(point, still, least + kNear), -0.5, 0.5));
  }
}

TEST(ConstraintByHand, AnAxisThatTurns) {
  const auto within = [](double most) {
    return Tilted{.frame = {.link = 0},
                  .reference = {},
                  .axis = Vector3d::UnitX(),
                  .direction = Vector3d::UnitX(),
                  .most = most};
  };
  EXPECT_TRUE(isShown(wheel(), within(0.5 + kNear), -0.5, 0.2));
  EXPECT_FALSE(isShown(wheel(), within(0.5 - kNear), -0.5, 0.2));
  EXPECT_TRUE(isShown(wheel(), within(2.5 + kNear), -0.1, 2.5));
  EXPECT_FALSE(isShown(wheel(), within(2.5 - kNear), -0.1, 2.5));
  EXPECT_TRUE(isShown(wheel(), within(std::numeric_limits<double>::infinity()), -2.9, 2.9));
}

/// Angles about z, and a rotation vector along it, are the joint's own; both are seen from behind a
/// quarter turn about x, by which the axis is y.
TEST(ConstraintByHand, AnOrientationThatTurns) {
  const auto within = [](Eigen::Index axis, double most, bool asVector) {
    Turned turned{.frame = {.link = 0}, .reference = {}, .asVector = asVector};
    turned.most = Vector3d::Constant(0.01);
    turned.most[axis] = most;
    if (axis == 1)
      turned.frame.link_from_frame.linear() = turned.reference.link_from_frame.linear() =
          Eigen::AngleAxisd(-M_PI / 2.0, Vector3d::UnitX()).toRotationMatrix();
    return turned;
  };
  for (const bool asVector : {false, true})
    for (const Eigen::Index axis : {2, 1}) {
      SCOPED_TRACE(std::to_string(axis) + (asVector ? " as a vector" : " as angles"));
      EXPECT_TRUE(isShown(wheel(), within(axis, 1.2 + kNear, asVector), -0.4, 1.2));
      EXPECT_FALSE(isShown(wheel(), within(axis, 1.2 - kNear, asVector), -0.4, 1.2));
    }
  EXPECT_TRUE(isShown(wheel(), within(2, 2.9 + kNear, false), -0.4, 2.9));
  EXPECT_FALSE(isShown(wheel(), within(2, 2.9 - kNear, false), -0.4, 2.9));
}

/// A vector along z by the desired orientation, while the frame turns about x: both coordinates
/// change, not as the spin alone says. R desired^-1 = Rx(q) Rz(2), whose vector is known by
/// quaternions.
TEST(ConstraintByHand, ALongRotationVector) {
  const auto vectorAt = [](double q) {
    const Eigen::AngleAxisd turn(Eigen::Quaterniond(Eigen::AngleAxisd(q, Vector3d::UnitX())) *
                                 Eigen::Quaterniond(Eigen::AngleAxisd(2.0, Vector3d::UnitZ())));
    return Vector3d(turn.angle() * turn.axis());
  };
  Model model = wheel();
  model.joints[0].axis = Vector3d::UnitX();
  Turned turned{.frame = {.link = 0}, .reference = {}, .asVector = true};
  turned.desired = Eigen::Quaterniond(Eigen::AngleAxisd(-2.0, Vector3d::UnitZ()));
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    double most = 0.0;
    for (int i = 0; i <= 1000; ++i) most = std::max(most, std::abs(vectorAt(0.001 * i)[axis]));
    turned.most = Vector3d::Constant(9.0);
    turned.most[axis] = most + 1e-5;
    EXPECT_TRUE(isShown(model, turned, 0.0, 1.0)) << axis;
    turned.most[axis] = most - 1e-7;
    EXPECT_FALSE(isShown(model, turned, 0.0, 1.0)) << axis;
  }
}

}  // namespace
}  // namespace swept::verify
