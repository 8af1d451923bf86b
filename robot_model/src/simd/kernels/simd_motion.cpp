// SPDX-License-Identifier: BSD-3-Clause
#include "simd/kernels/simd_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simd/kernels/simd_kinematics.hpp"
#include "swept/core/axis_frame.hpp"

namespace swept::detail {

namespace {

/// rad; what sines and cosines are good for.
constexpr double kFarthest = 100.0;

/// More than the rounding of a double to single precision.
constexpr double kOutward = 1.0 + 2.0 * kSingle;

/// Of the lane frame of a body in that of its parent, and of what a floating joint is turned by
/// before: Rot(axis, angle) R = S Rz(angle) (S^T R) for any rotation S that takes z to the axis.
void compileFloating(const MovingBody& body, const JointMotion& joint, SimdJointMotion& lane) {
  Eigen::Matrix3d toAxis = Eigen::Matrix3d::Identity();
  if (joint.spinSpeed > 0.0) toAxis = axisFrame(joint.spin);
  const Eigen::Matrix3d before = body.parent_from_joint.linear() * toAxis;
  const Eigen::Matrix3d after = toAxis.transpose() * joint.rotation.toRotationMatrix();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      lane.rotation[3 * r + c] = static_cast<float>(before(r, c));
      lane.after[3 * r + c] = static_cast<float>(after(r, c));
    }
  }
}

/// What the error of a whole motion depends on.
struct Extent {
  double largestAngle = 0.0;  ///< rad
  double spins = 0.0;         ///< rad per unit t, of all joints
  double speeds = 0.0;        ///< m per unit t, of all joints
  double slid = 0.0;          ///< m, of all joints
  double slideError = 0.0;    ///< m, likewise
};

/// rad. Beyond, the rounding of 2 pi shows in what is left of an angle when turns are taken off.
constexpr double kLargestAngle = 1e6;

bool addTurn(double angle, double rate, double spin, SimdJointMotion& lane, Extent& extent) {
  if (!(std::abs(angle) <= kLargestAngle)) return false;
  if (std::abs(angle) > 4.0) angle = std::remainder(angle, 2.0 * std::numbers::pi);
  lane.angle = static_cast<float>(angle);
  lane.angleRate = static_cast<float>(rate);
  lane.spin = static_cast<float>(spin * kOutward);
  const double reached = std::abs(angle) + std::abs(rate);
  extent.largestAngle = std::max(extent.largestAngle, reached);
  extent.spins += spin;
  return reached <= kFarthest;  // not if it is no number
}

/// Any joint that does not only turn.
bool addSlide(const SimdModel& model, const KinematicModel& kinematics, std::size_t index,
              std::span<const double> from, std::span<const double> to, SimdJointMotion& lane,
              Extent& extent) {
  const MovingBody& body = kinematics.bodies[index];
  JointMotion joint;
  if (!compileJoint(kinematics, body, from, to, joint)) return false;
  if (!(joint.largestAngle <= kLargestAngle)) return false;
  // The largest of several may leave out what is no number: a walk must never see it.
  if (!std::isfinite(joint.maxTranslation + joint.high - joint.low + joint.speed)) return false;
  const bool floating = body.type == JointType::Floating;
  // Slides are written in the parent's frame.
  const Eigen::Matrix3d lane_from_joint =
      model.parentLaneFromParent[index] * body.parent_from_joint.linear();
  const Eigen::Vector3d slide = lane_from_joint * joint.translation;
  const Eigen::Vector3d slideRate = lane_from_joint * joint.rate;
  for (int k = 0; k < 3; ++k) {
    lane.slide[k] = static_cast<float>(slide[k]);
    lane.slideRate[k] = static_cast<float>(slideRate[k]);
  }
  lane.speed = static_cast<float>(joint.speed * kOutward);
  extent.speeds += joint.speed;
  lane.slid = static_cast<float>(joint.slid() * kOutward);
  extent.slid += joint.slid();
  extent.slideError += joint.slideError;
  if (floating) compileFloating(body, joint, lane);
  return addTurn(floating ? 0.0 : joint.angle, floating ? joint.spinSpeed : joint.angleRate,
                 joint.spinSpeed, lane, extent);
}

/// The motion's joints, and what their error depends on.
bool addJoints(const SimdModel& model, const KinematicModel& kinematics,
               std::span<const double> from, std::span<const double> to, SimdScratch& scratch,
               Extent& extent) {
  for (std::size_t i = 1; i < kinematics.bodies.size(); ++i) {
    const MovingBody& body = kinematics.bodies[i];
    if (model.bodies[i].kind != SimdJointKind::Turn) {
      if (!addSlide(model, kinematics, i, from, to, scratch.motion[i], extent)) return false;
      continue;
    }
    const double begin = from[body.variable];
    const double end = to[body.variable];
    const bool cyclic = kinematics.cyclic[body.variable] != 0;
    const double angle = body.multiplier * begin + body.offset;
    // The shorter way from a small angle to a large one is small, and rounds as the large one does.
    if (!(std::abs(body.multiplier * end) <= kLargestAngle)) return false;
    const double rate = body.multiplier * (cyclic ? cyclicDifference(begin, end) : end - begin);
    if (!addTurn(angle, rate, std::abs(rate), scratch.motion[i], extent)) return false;
    const bool within =
        std::min(angle, angle + rate) >= body.lower && std::max(angle, angle + rate) <= body.upper;
    scratch.withinLimits = scratch.withinLimits && (within || body.type == JointType::Continuous);
  }
  return true;
}

/// Lemma: a rotation is off by at most 32 kSingle (1 + a / 8) more than its parent's, a the largest
/// angle: 4 kSingle a from the angle, 5 kSingle from the sine and cosine, and two products with
/// three terms each. A position is off by the sum of these times what lies beyond, at most the
/// reach at rest and what is slid, plus its own sums; a velocity by as much times the sum of the
/// spins, of which half an interval counts at most a half. What is slid takes points as much
/// farther from the obstacles' frames as well.
bool setRounding(const SimdModel& model, const Extent& extent, SimdScratch& scratch) {
  const double reach = model.reach + extent.slid;
  const double relative = static_cast<double>(model.rounding) * (1.0 + extent.largestAngle / 8.0);
  const double rounding = relative * (reach * (1.0 + 0.5 * extent.spins) + 0.5 * extent.speeds) +
                          64.0 * kSingle * extent.slid + extent.slideError;
  scratch.rounding = static_cast<float>(rounding);
  return rounding < 1.0;
}

}  // namespace

bool compileSimdMotion(const SimdModel& model, const KinematicModel& kinematics,
                       std::span<const double> from, std::span<const double> to,
                       SimdScratch& scratch) {
  Extent extent;
  scratch.withinLimits = true;
  if (!addJoints(model, kinematics, from, to, scratch, extent)) return false;
  boundMotion(model, scratch);
  return setRounding(model, extent, scratch);
}

bool compileSimdState(const SimdModel& model, const KinematicModel& kinematics,
                      std::span<const double> q, SimdScratch& scratch) {
  Extent extent;
  scratch.withinLimits = true;
  return addJoints(model, kinematics, q, q, scratch, extent) && setRounding(model, extent, scratch);
}

bool compileSimdStates(const SimdModel& model, const KinematicModel& kinematics,
                       std::span<const double> states, SimdScratch& scratch) {
  if (model.floats) return false;
  const auto dimension = static_cast<std::size_t>(kinematics.dimension);
  const std::size_t count = states.size() / dimension;
  Extent extent;
  scratch.withinLimits = true;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::span<const double> q =
        states.subspan((lane < count ? lane : 0) * dimension, dimension);
    Extent own;
    if (!addJoints(model, kinematics, q, q, scratch, own)) return false;
    extent.largestAngle = std::max(extent.largestAngle, own.largestAngle);
    extent.slid = std::max(extent.slid, own.slid);
    extent.slideError = std::max(extent.slideError, own.slideError);
    for (std::size_t i = 1; i < model.bodies.size(); ++i) {
      scratch.block.angle[i].lane[lane] = scratch.motion[i].angle;
      for (std::size_t k = 0; k < 3; ++k)
        scratch.block.slide[3 * i + k].lane[lane] = scratch.motion[i].slide[k];
    }
  }
  return setRounding(model, extent, scratch);
}

}  // namespace swept::detail
