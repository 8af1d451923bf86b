// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "swept/core/continuous/motion.hpp"

namespace swept {

/// A point of the body moves straight, at constant speed, while the body turns about an axis of
/// fixed direction at constant angular speed. Standing still, translation, linear interpolation
/// with slerp, and screws are all of this kind.
///
/// Each function throws std::invalid_argument for a pose or vector that is not finite, or if the
/// linear part of a pose is farther than 1e-6 from a rotation; a closer one becomes the nearest
/// rotation.
class UniformMotion : public Motion {
 public:
  /// A body that stands still.
  static UniformMotion still(const Eigen::Isometry3d& pose);
  /// A straight motion without rotation. `displacement`: m, world frame.
  static UniformMotion translation(const Eigen::Isometry3d& start,
                                   const Eigen::Vector3d& displacement);
  /// From one pose to another: the reference point (m, body frame) moves straight, the rotation is
  /// slerp along the shorter way.
  static UniformMotion interpolation(const Eigen::Isometry3d& start, const Eigen::Isometry3d& end,
                                     const Eigen::Vector3d& reference = Eigen::Vector3d::Zero());
  /// From one pose to another as one screw: rotation about one fixed axis and translation along it
  /// (Chasles). Below 1e-8 rad it is the interpolation, which differs by less than 2e-9 of the
  /// displacement.
  static UniformMotion screw(const Eigen::Isometry3d& start, const Eigen::Isometry3d& end);
  /// Rotation by `turn` (rad, a rotation vector in the world frame, of any length) while the
  /// reference point moves by `displacement` (m, world frame).
  static UniformMotion turning(const Eigen::Isometry3d& start, const Eigen::Vector3d& turn,
                               const Eigen::Vector3d& displacement,
                               const Eigen::Vector3d& reference = Eigen::Vector3d::Zero());

  Eigen::Isometry3d at(double t) const override;
  Twist velocity(double t) const override;
  MotionRates rates(double from, double to) const override;
  double rounding(double reach) const override;

 private:
  UniformMotion(const Eigen::Isometry3d& start, const Eigen::Vector3d& turn,
                const Eigen::Vector3d& displacement, const Eigen::Vector3d& reference);
  Eigen::Matrix3d rotation_;      ///< at t = 0
  Eigen::Vector3d position_;      ///< m, of the reference point at t = 0
  Eigen::Vector3d displacement_;  ///< m
  Eigen::Vector3d axis_;          ///< unit, world frame; zero if the body does not turn
  double angle_ = 0.0;            ///< rad
};

/// A control pose of a Bézier curve or spline: the position of the body's origin (m), and a
/// rotation vector (rad) that rotates the start's orientation, R(t) = exp(rotation(t)) R(start).
struct ControlPose {
  Eigen::Vector3d position;  ///< m, world frame
  Eigen::Vector3d rotation;  ///< rad, world frame
};

/// Piecewise Bézier curves in position and rotation vector, with a continuous first derivative.
class SplineMotion : public Motion {
 public:
  /// One Bézier curve with these control poses, at least two and at most eight. `orientation` is
  /// R(start).
  static SplineMotion bezier(const Eigen::Matrix3d& orientation,
                             std::span<const ControlPose> control);
  /// The uniform cubic B-spline of four or more control poses. Each four consecutive ones make a
  /// span of equal duration. With four it is FCL's SplineMotion.
  static SplineMotion uniformCubic(const Eigen::Matrix3d& orientation,
                                   std::span<const ControlPose> control);

  Eigen::Isometry3d at(double t) const override;
  Twist velocity(double t) const override;
  MotionRates rates(double from, double to) const override;
  double rounding(double reach) const override;

 private:
  SplineMotion(const Eigen::Matrix3d& orientation, std::vector<ControlPose> control, int degree);
  Eigen::Matrix3d orientation_;
  std::vector<ControlPose> control_;  ///< degree_ + 1 of each span, one span after the other
  int degree_;
  int spans_;
  double reach_ = 0.0;  ///< m, the longest position
  double turn_ = 0.0;   ///< rad, the longest rotation vector
};

/// A part [from, to] of another motion as a motion from 0 to 1. Refers to the other.
class MotionPart : public Motion {
 public:
  /// Throws std::invalid_argument unless 0 <= from <= to <= 1.
  MotionPart(const Motion& whole, double from, double to);

  Eigen::Isometry3d at(double t) const override;
  Twist velocity(double t) const override;
  MotionState state(double t) const override;
  MotionRates rates(double from, double to) const override;
  double rounding(double reach) const override;

 private:
  const Motion& whole_;
  double from_;
  double length_;
};

/// The motion of a frame that is fixed in a moving body, for example of a shape beside a link's
/// origin. Refers to the body's motion.
class AttachedFrame : public Motion {
 public:
  /// Throws std::invalid_argument as UniformMotion does.
  AttachedFrame(const Motion& body, const Eigen::Isometry3d& body_from_frame);

  Eigen::Isometry3d at(double t) const override;
  Twist velocity(double t) const override;
  MotionState state(double t) const override;
  MotionRates rates(double from, double to) const override;
  double rounding(double reach) const override;

 private:
  const Motion& body_;
  Eigen::Isometry3d body_from_frame_;
};

}  // namespace swept
