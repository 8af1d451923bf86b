// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "kinematics/motion_model.hpp"
#include "swept/robot_model/robot.hpp"

/// How searches move a configuration: along its degrees of freedom, within its limits.
namespace swept::detail {

/// One degree of freedom of a configuration: a variable's value, or a rotation of a quaternion.
struct Degree {
  int variable = 0;     ///< of a rotation: the first of the quaternion's four
  bool turn = false;    ///< of a quaternion
  bool cyclic = false;  ///< an angle modulo 2 pi
  bool slides = false;  ///< in m
  double low = -std::numeric_limits<double>::infinity();  ///< rad or m
  double high = std::numeric_limits<double>::infinity();  ///< rad or m

  /// Whether a value is at a limit beyond which it would be moved.
  bool isHeld(double value, double step) const {
    return !turn && ((step < 0.0 && value <= low) || (step > 0.0 && value >= high));
  }
};

/// Those of a group, in the order of its variables. The three of a quaternion are rotations of the
/// joint's child frame about the axes of the joint frame.
struct DegreesOfFreedom {
  std::vector<Degree> degrees;
  std::vector<int> degreeOf;     ///< per variable; a quaternion's four have the first rotation
  std::vector<int> quaternions;  ///< the first variable of each

  int count() const { return static_cast<int>(degrees.size()); }
  /// Tighter limits (rad or m), one for each variable of the group. A limit beyond the present ones
  /// by at most tolerance::kLimit becomes equal to them; those of cyclic variables and quaternions
  /// are ignored. Returns the variable of the group to which no value is left.
  std::optional<int> limit(std::span<const double> lower, std::span<const double> upper);
  /// Moves values to the limits, into [-pi, pi], and to unit length.
  void putInPlace(std::span<double> q) const;
  /// `to` becomes `from`, moved by a step along each degree, put in place. `scale`: m of a slide
  /// per unit of its step.
  void move(std::span<const double> from, const Eigen::VectorXd& step, double scale,
            std::span<double> to) const;
};

DegreesOfFreedom degreesOfFreedom(const Robot& robot, const Group& group);

/// Velocity of a point (m, rows 0 to 2) and angular velocity (rad, rows 3 to 5), both in the model
/// frame, per unit (rad or m) of each degree of freedom.
using PointJacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Adds `sign` times the contribution of one joint; several joints may follow one variable. `axes`:
/// of the joint frame; `center`: the origin of the body that it moves; `point`: all in the model
/// frame.
void addJointColumns(const DegreesOfFreedom& freedom, const MovingBody& body,
                     const Eigen::Matrix3d& axes, const Eigen::Vector3d& center,
                     const Eigen::Vector3d& point, double sign, PointJacobian& jacobian);

/// The rotation vector (rad) of a rotation by at most half a turn.
Eigen::Vector3d rotationVector(const Eigen::Matrix3d& rotation);

}  // namespace swept::detail
