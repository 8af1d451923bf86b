// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>

#include "kinematics/lever_arms.hpp"
#include "kinematics/motion_model.hpp"
#include "rounding/error_model.hpp"

namespace swept::detail {

/// rad per unit t; bounds the angular velocity of a body relative to its parent's parent, if both
/// joints only turn. Two consecutive axes keep the angle between them, so their velocities add as
/// vectors.
inline double boundTogether(const KinematicModel& model, const MovingBody& body, double parentRate,
                            double rate) {
  const Eigen::Vector3d inParentFrame = body.parent_from_joint.linear() * body.axis;
  const double cosine = std::abs(inParentFrame.dot(model.bodies[body.parent].axis));
  return std::sqrt(parentRate * parentRate + rate * rate +
                   2.0 * parentRate * rate * std::min(1.0, cosine)) *
         kArithmeticOutward;
}

/// rad per unit t: W of L3 in ERROR_MODEL.md, which bounds the angular velocity of one body after
/// the other on a path, relative to where the path begins.
class TurningBound {
 public:
  double now() const { return now_; }
  /// Goes on to the next body, whose joint turns by no more than `rate`.
  void pass(const KinematicModel& model, const MovingBody& body, double rate) {
    double next = now_ + rate;
    const bool turnsToo = turns(body.type);
    if (turnsToo && lastTurns_)
      next = std::min(next, before_ + boundTogether(model, body, lastRate_, rate));
    before_ = now_;
    now_ = next;
    lastRate_ = rate;
    lastTurns_ = turnsToo;
  }

 private:
  double now_ = 0.0;
  double before_ = 0.0;  ///< of the parent
  double lastRate_ = 0.0;
  bool lastTurns_ = false;
};

/// The bounds of pointMotionBound, relative to all of a ball's ancestors together: bounds[first],
/// with `first` up to the number of joints of the path. One by one they take a time proportional to
/// the square of that, and a motion of a chain of n bodies a time proportional to n^3. `path` and
/// `arms` as in LeverArms.
///
/// Lemma. Let V(i) bound the angular velocity of body i of the path relative to the model frame as
/// pointMotionBound has it: the length of the shortest way to it along its ancestors, with steps of
/// s (the spin) from a body to the next, and of t (boundTogether) past one. Relative to an ancestor
/// r whose joint on the way to i is c, pointMotionBound has the length W(i) of the shortest way
/// from r. The way to i either passes r, and then V(i) = V(r) + W(i); or it goes past r, and then
/// V(i) = V(p) + t + (the way from c to i) for r's parent p, where V(p) >= V(r) - s_r, and the way
/// from c to i is no less than W(i) - s_c. So
///   W(i) <= V(i) - V(r) + d,  d = max(0, s_r + s_c - t) where both turn, else 0.
/// With l_m the speed of joint m's slide, the acceleration relative to r is at most the sum over
/// the joints m from c on of 2 W(m's parent) w_m + e_m, where W(r) = 0, w_m = s_m arm_m + l_m, and
/// e_m = (s_m^2 + b_m) arm_m + a_m with b_m and a_m the accelerations of m's turn and slide:
///   e_c + sum over m beyond c of (2 V(m's parent) w_m + e_m)
///   - 2 (V(r) - d) sum over m beyond c of w_m.
/// Both sums go on from one r to its parent, so that each takes one step.
void nestedMotionBounds(const KinematicModel& model, std::span<const int> path,
                        std::span<const double> arms, std::span<const JointMotion> motion,
                        std::span<PointMotionBound> bounds);

}  // namespace swept::detail
