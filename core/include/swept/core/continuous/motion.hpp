// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <utility>

#include "swept/core/bounding_sphere.hpp"
#include "swept/core/shapes.hpp"

namespace swept {

/// Velocity of a rigid body, per unit of t.
struct Twist {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< m, world frame, of the reference point
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< rad, world frame
};

/// Pose and velocity of a body at one t.
struct MotionState {
  Eigen::Isometry3d pose;  ///< world_from_body
  Twist twist;             ///< at the same t
};

/// Upper bounds on the velocities and accelerations of a body during an interval, per unit of t.
struct MotionRates {
  double speed = 0.0;                ///< m, of the reference point
  double acceleration = 0.0;         ///< m, of the reference point
  double angularSpeed = 0.0;         ///< rad
  double angularAcceleration = 0.0;  ///< rad
};

/// How far the points of a ball that moves with a body can move during an interval [m - h, m + h].
///
/// Along a fixed unit vector n, every point p of the ball moves by at most h |n . v(c)| + h |n x w|
/// r + curvature from its place at m. Here c and r are the ball's centre and radius, v and w
/// velocities at m (see ApproachBound).
struct MotionBound {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();  ///< m, world frame, h v(c)
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();    ///< rad, world frame, h w
  double radius = 0.0;                               ///< m
  double curvature = 0.0;                            ///< m, h^2 / 2 times the largest acceleration
  double travel = 0.0;                               ///< m, h times the largest speed

  /// m. No point moves farther than this along the unit vector n (world frame), or against it.
  double along(const Eigen::Vector3d& n) const;
  /// m, >= along(n) for every n.
  double most() const;
};

/// The pose of a rigid body at each t in [0, 1]. Its velocity is continuous.
///
/// Implementations are const and any number of threads may use them. Their bounds hold for the
/// motion in real numbers; at() and velocity() may round it by up to `rounding()`.
class Motion {
 public:
  virtual ~Motion() = default;

  /// Pose world_from_body at t. A non-finite t gives a non-finite pose.
  virtual Eigen::Isometry3d at(double t) const = 0;
  /// Velocity at t, per unit of t, of the body as at() places it.
  virtual Twist velocity(double t) const = 0;
  /// Both at once, for motions that can compute them together with less work.
  virtual MotionState state(double t) const { return {at(t), velocity(t)}; }
  /// Upper bounds over [from, to].
  virtual MotionRates rates(double from, double to) const = 0;

  /// m, body frame: the point that Twist::linear and MotionRates describe.
  const Eigen::Vector3d& reference() const { return reference_; }
  /// m. Bound on the rounding of at() for a point within `reach` (m) of the body's origin, and of
  /// velocity(), per unit of t.
  virtual double rounding(double reach) const = 0;

  /// Bound for a ball (m, body frame) over [from, to]. For a ball of infinite radius `most` is
  /// infinite, unless the body does not turn.
  MotionBound bound(const BoundingSphere& ball, double from, double to) const;

 protected:
  /// `reference`: m, body frame.
  explicit Motion(Eigen::Vector3d reference) : reference_(std::move(reference)) {}
  Motion(const Motion&) = default;
  Motion(Motion&&) = default;
  Motion& operator=(const Motion&) = default;
  Motion& operator=(Motion&&) = default;

 private:
  Eigen::Vector3d reference_;
};

}  // namespace swept
