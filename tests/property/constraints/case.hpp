// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "robot.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/task_constraint.hpp"
#include "swept/robot_model/tracking_tolerance.hpp"

namespace constraints {

/// Kinds of constraints that a case has one of.
enum class Kind : std::uint8_t { Joint, Box, Sphere, Cylinder, Euler, RotationVector, Axis };
inline constexpr int kKinds = 7;

/// A robot, constraints, and a motion or a curve that begins, ends or passes near them.
struct Case {
  RandomRobot robot;
  swept::TaskConstraint constraint;
  Kind kind = Kind::Joint;  ///< of the first one
  std::vector<double> from, to;
  std::optional<swept::PiecewisePolynomial> curve;  ///< instead of the straight motion
  swept::TrackingTolerance tracking;
  bool inTube = false;

  /// Values at a share of the motion or the curve.
  std::vector<Real> at(Real t) const;
  /// rad or m: the most that a value changes from one end to the other, or along the curve.
  double length() const;
};

Case makeCase(std::uint64_t seed, std::uint64_t index);

/// rad or m. How far the constraints are from holding at a configuration, negative: how far within.
/// An own reading of what TaskConstraint says.
Real excess(const Case& of, const std::vector<Real>& q);
/// Of one constraint alone.
Real excessOfJoint(const RandomRobot& robot, const swept::JointConstraint& own,
                   const std::vector<Real>& q);
Real excessOf(const RandomRobot& robot, const swept::PositionConstraint& own,
              const std::vector<Real>& q);
Real excessOf(const RandomRobot& robot, const swept::OrientationConstraint& own,
              const std::vector<Real>& q);
Real excessOf(const RandomRobot& robot, const swept::AxisConstraint& own,
              const std::vector<Real>& q);

}  // namespace constraints
