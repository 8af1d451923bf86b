// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/nested_motion_bounds.hpp"

namespace swept::detail {

namespace {

/// Of sums of so many positive terms as a robot has joints, and of what they are made of.
constexpr double kNestedOutward = 1.0 + 1e-11;
/// The same, per joint.
constexpr double kRounding = 8.0 * 0x1p-53;

/// V(r) and d of the lemma, for r the parent of path[first].
struct Around {
  double turning = 0.0;
  double excess = 0.0;
};

/// Kept where the bounds will be, until each is known.
Around aroundOf(const PointMotionBound& kept) {
  return {kept.acceleration, kept.speed};
}

void keepAround(const KinematicModel& model, std::span<const int> path,
                std::span<const JointMotion> motion, std::span<PointMotionBound> bounds) {
  Around around;
  double turningBefore = 0.0;  // of the parent of r
  double previousRate = 0.0;
  bool previousTurns = false;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const MovingBody& body = model.bodies[path[i]];
    const double rate = motion[path[i]].spinSpeed;
    double next = around.turning + rate;
    around.excess = 0.0;
    if (turns(body.type) && previousTurns) {
      const double together = boundTogether(model, body, previousRate, rate);
      next = std::min(next, turningBefore + together);
      around.excess = std::max(0.0, previousRate + rate - together);
    }
    bounds[i] = {around.excess, around.turning};
    turningBefore = around.turning;
    around.turning = next;
    previousRate = rate;
    previousTurns = turns(body.type);
  }
}

}  // namespace

void nestedMotionBounds(const KinematicModel& model, std::span<const int> path,
                        std::span<const double> arms, std::span<const JointMotion> motion,
                        std::span<PointMotionBound> bounds) {
  keepAround(model, path, motion, bounds);
  bounds[path.size()] = {};
  const double rounding = kRounding * static_cast<double>(path.size() + 1);
  double maxTranslation = 0.0;  // of the joints beyond
  double carried = 0.0;         // sum of w beyond
  double driven = 0.0;          // of 2 V w + e
  double speed = 0.0;
  for (std::size_t i = path.size(); i-- > 0;) {
    const JointMotion& joint = motion[path[i]];
    const Around around = aroundOf(bounds[i]);
    // Planar and floating joints farther out carry the ball away from this axis.
    const double arm = arms[i] + maxTranslation * kNestedOutward;
    const double own =
        (joint.spinSpeed * joint.spinSpeed + joint.spinAcceleration) * arm + joint.acceleration;
    const double moved = joint.spinSpeed * arm + joint.speed;
    const double sum = driven + own - 2.0 * (around.turning - around.excess) * carried;
    const double error =
        rounding * (driven + own + 2.0 * (around.turning + around.excess) * carried);
    speed += moved;
    bounds[i] = {speed * kNestedOutward, (std::max(0.0, sum) + error) * kNestedOutward};
    carried += moved;
    driven += 2.0 * around.turning * moved + own;
    maxTranslation += joint.maxTranslation;
  }
}

}  // namespace swept::detail
