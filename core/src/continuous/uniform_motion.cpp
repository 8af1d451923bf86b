// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "continuous/motion_input.hpp"
#include "swept/core/continuous/motions.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// rad. Below it a screw's axis is so far away that its position is lost to rounding, by more than
/// the screw differs from a straight line between the same ends.
constexpr double kHardlyTurns = 1e-7;

/// The shortest rotation vector that takes one orientation to the other.
Vector3d turnBetween(const Matrix3d& start, const Matrix3d& end) {
  const Eigen::AngleAxisd turn(Eigen::Quaterniond(Matrix3d(end * start.transpose())).normalized());
  return turn.angle() * turn.axis();
}

}  // namespace

UniformMotion::UniformMotion(const Isometry3d& start, const Vector3d& turn,
                             const Vector3d& displacement, const Vector3d& reference)
    : Motion(reference),
      rotation_(start.linear()),
      position_(start * reference),
      displacement_(displacement),
      axis_(turn.isZero(0.0) ? Vector3d(Vector3d::Zero()) : turn.stableNormalized()),
      angle_(turn.stableNorm()) {}

UniformMotion UniformMotion::still(const Isometry3d& pose) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return UniformMotion::still(pose); });
  }
  return translation(pose, Vector3d::Zero());
}

UniformMotion UniformMotion::translation(const Isometry3d& start, const Vector3d& displacement) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return UniformMotion::translation(start, displacement); });
  }
  return turning(start, Vector3d::Zero(), displacement);
}

UniformMotion UniformMotion::interpolation(const Isometry3d& start, const Isometry3d& end,
                                           const Vector3d& reference) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&] { return UniformMotion::interpolation(start, end, reference); });
  }
  const Isometry3d from = detail::checkedPose(start, "start");
  const Isometry3d to = detail::checkedPose(end, "end");
  detail::requireFinite(reference, "reference");
  return {from, turnBetween(from.linear(), to.linear()), to * reference - from * reference,
          reference};
}

// Chasles: with the displacement d of the origin and the rotation by theta about u, a point of the
// axis is the origin's middle plus (u x d) / (2 tan(theta / 2)).
UniformMotion UniformMotion::screw(const Isometry3d& start, const Isometry3d& end) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return UniformMotion::screw(start, end); });
  }
  const Isometry3d from = detail::checkedPose(start, "start");
  const Isometry3d to = detail::checkedPose(end, "end");
  const Vector3d turn = turnBetween(from.linear(), to.linear());
  const double angle = turn.norm();
  const Vector3d displacement = to.translation() - from.translation();
  if (!(angle > kHardlyTurns)) return {from, turn, displacement, Vector3d::Zero()};
  const Vector3d axis = turn / angle;
  const Vector3d along = axis.dot(displacement) * axis;
  const Vector3d across = displacement - along;
  const Vector3d toAxis = 0.5 * across + axis.cross(across) / (2.0 * std::tan(0.5 * angle));
  return {from, turn, along, from.linear().transpose() * toAxis};
}

UniformMotion UniformMotion::turning(const Isometry3d& start, const Vector3d& turn,
                                     const Vector3d& displacement, const Vector3d& reference) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&] { return UniformMotion::turning(start, turn, displacement, reference); });
  }
  detail::requireFinite(turn, "turn");
  detail::requireFinite(displacement, "displacement");
  detail::requireFinite(reference, "reference");
  return {detail::checkedPose(start, "start"), turn, displacement, reference};
}

Isometry3d UniformMotion::at(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, t] { return UniformMotion::at(t); });
  }
  Isometry3d pose;
  if (angle_ > 0.0) {
    pose.linear() = Eigen::AngleAxisd(t * angle_, axis_).toRotationMatrix() * rotation_;
  } else {
    pose.linear() = rotation_;
  }
  pose.translation() = position_ + t * displacement_ - pose.linear() * reference();
  pose.makeAffine();
  return pose;
}

Twist UniformMotion::velocity(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, t] { return UniformMotion::velocity(t); });
  }
  return {displacement_, angle_ * axis_};
}

MotionRates UniformMotion::rates(double from, double to) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, from, to] { return UniformMotion::rates(from, to); });
  }
  return {displacement_.norm() * (1.0 + 1e-15), 0.0, angle_ * (1.0 + 1e-15), 0.0};
}

// An angle of many turns is known only to an ulp of itself.
double UniformMotion::rounding(double reach) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, reach] { return UniformMotion::rounding(reach); });
  }
  return tolerance::kRoundingPerJoint *
         ((1.0 + angle_) * (reach + reference().norm()) + position_.norm() + displacement_.norm());
}

}  // namespace swept
