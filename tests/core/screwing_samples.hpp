// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "swept/core/separation.hpp"
#include "swept/core/shapes.hpp"

/// Motions whose velocities are known, for tests of what is proven about two bodies that move.
namespace swept::test {

/// A body that turns about an axis through its frame's origin while this moves along a line: the
/// pose at s in [-1, 1] is [exp(s spin) R | p + s velocity].
struct Screwing {
  Eigen::Isometry3d middle;
  Eigen::Vector3d velocity;  ///< m
  Eigen::Vector3d spin;      ///< rad

  Eigen::Isometry3d at(double s) const {
    Eigen::Isometry3d pose = middle;
    pose.translation() += s * velocity;
    const double rate = spin.norm();
    if (rate > 0.0) pose.linear() = Eigen::AngleAxisd(s * rate, spin / rate) * middle.linear();
    return pose;
  }
  /// Of a point of the body, at s = 0.
  Eigen::Vector3d velocityOf(const Eigen::Vector3d& local) const {
    return velocity + spin.cross(Eigen::Vector3d(middle.linear() * local));
  }
};

/// Over s in [-1, 1], in a's frame at s = 0.
inline ApproachBound approachOf(const Shape& a, const Screwing& moveA, const Shape& b,
                                const Screwing& moveB) {
  const BoundingSphere ballA = boundingSphere(a);
  const BoundingSphere ballB = boundingSphere(b);
  const Eigen::Matrix3d a_from_world = moveA.middle.linear().transpose();
  const double armA = ballA.center.norm() + ballA.radius;
  const double armB = ballB.center.norm() + ballB.radius;
  ApproachBound bound;
  bound.linear = a_from_world * (moveB.velocityOf(ballB.center) - moveA.velocityOf(ballA.center));
  bound.spinA = a_from_world * moveA.spin;
  bound.spinB = a_from_world * moveB.spin;
  bound.ballA = ballA;
  bound.ballB = {moveA.middle.inverse() * (moveB.middle * ballB.center), ballB.radius};
  bound.curvature = 0.5 * (armA * moveA.spin.squaredNorm() + armB * moveB.spin.squaredNorm());
  bound.travel = moveA.velocity.norm() + moveB.velocity.norm() + armA * moveA.spin.norm() +
                 armB * moveB.spin.norm();
  bound.required = 1e-12;
  return bound;
}

}  // namespace swept::test
