// SPDX-License-Identifier: BSD-3-Clause
#include "simd/kernels/simd_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rounding/error_model.hpp"
#include "simd/kernels/simd_kinematics.hpp"
#include "swept/core/axis_frame.hpp"

namespace swept::detail {

namespace {

/// The frame of a body here relative to that of its parent, and the rotation applied to a floating
/// joint before: Rot(axis, angle) R = S Rz(angle) (S^T R) for any rotation S that takes z to the
/// axis.
[[gnu::always_inline]] inline void compileFloating(const MovingBody& body, const JointMotion& joint,
                                                   SimdJointMotion& lane) {
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

/// What the error of a whole motion depends on; the reach is added at the end.
struct Extent {
  MotionExtent motion;
  bool withinLimits = true;  ///< all joints that only turn
};

/// rad. Beyond it, the rounding of 2 pi shows when turns are subtracted from an angle.
constexpr double kLargestAngle = 1e6;

/// rad. The same rotation, near 0 if the angle is large.
double nearZero(double angle) {
  return std::abs(angle) > 4.0 ? std::remainder(angle, 2.0 * std::numbers::pi) : angle;
}

/// `travel`: rad, upper bound on the difference of the angle from its value at the anchor.
bool addTurn(double angle, double rate, double spin, double travel, SimdJointMotion& lane,
             Extent& extent) {
  if (!(std::abs(angle) <= kLargestAngle)) return false;
  angle = nearZero(angle);
  lane.angle = static_cast<float>(angle);
  lane.angleRate = static_cast<float>(rate);
  lane.spin = static_cast<float>(spin * kSingleOutward);
  const double reached = std::abs(angle) + travel;
  extent.motion.largestAngle = std::max(extent.motion.largestAngle, reached);
  extent.motion.spins += spin;
  return reached <= kLargestTurn;  // not if it is no number
}

/// Slides are written in the parent's frame.
[[gnu::always_inline]] inline void setSlides(const SimdModel& model, const MovingBody& body,
                                             std::size_t index, const JointMotion& joint,
                                             SimdJointMotion& lane) {
  const Eigen::Matrix3d lane_from_joint =
      model.parentLaneFromParent[index] * body.parent_from_joint.linear();
  const Eigen::Vector3d slide = lane_from_joint * joint.translation;
  const Eigen::Vector3d slideRate = lane_from_joint * joint.rate;
  for (int k = 0; k < 3; ++k) {
    lane.slide[k] = static_cast<float>(slide[k]);
    lane.slideRate[k] = static_cast<float>(slideRate[k]);
  }
}

/// For any joint that does not only turn.
bool addSlide(const SimdModel& model, const KinematicModel& kinematics, std::size_t index,
              const JointMotion& joint, SimdJointMotion& lane, Extent& extent) {
  const MovingBody& body = kinematics.bodies[index];
  if (!(joint.largestAngle <= kLargestAngle)) return false;
  // The largest of several may drop a NaN: a walk must never see it.
  if (!std::isfinite(joint.maxTranslation + joint.high - joint.low + joint.speed)) return false;
  setSlides(model, body, index, joint, lane);
  lane.speed = static_cast<float>(joint.speed * kSingleOutward);
  extent.motion.speeds += joint.speed;
  lane.slid = static_cast<float>(joint.slid() * kSingleOutward);
  extent.motion.slid += joint.slid();
  extent.motion.slideError += joint.slideError;
  const bool floating = body.type == JointType::Floating;
  if (floating) compileFloating(body, joint, lane);
  const double rate = floating ? joint.spinSpeed : joint.angleRate;
  return addTurn(floating ? 0.0 : joint.angle, rate, joint.spinSpeed,
                 joint.hasConstantRates() ? std::abs(rate) : joint.spinSpeed, lane, extent);
}

bool isWithin(const MovingBody& body, double low, double high) {
  return (low >= body.lower && high <= body.upper) || body.type == JointType::Continuous;
}

/// For a joint that only turns, at a constant rate: from the ends of a straight path. The
/// additional data for exact geometry would take a tenth of the time of a motion that is soon
/// proven.
bool addStraightTurn(const KinematicModel& kinematics, const MovingBody& body,
                     std::span<const double> from, std::span<const double> to,
                     SimdJointMotion& lane, Extent& extent) {
  const double begin = from[body.variable];
  const double end = to[body.variable];
  const bool cyclic = kinematics.cyclic[body.variable] != 0;
  const double angle = body.multiplier * begin + body.offset;
  // The shorter way from a small angle to a large one is small, but rounds as the large one does.
  if (!(std::abs(body.multiplier * end) <= kLargestAngle)) return false;
  const double rate = body.multiplier * (cyclic ? cyclicDifference(begin, end) : end - begin);
  if (!addTurn(angle, rate, std::abs(rate), std::abs(rate), lane, extent)) return false;
  extent.withinLimits &=
      isWithin(body, std::min(angle, angle + rate), std::max(angle, angle + rate));
  return true;
}

/// The joints of a straight path, or of a state that stays, and the data of their error.
bool addStraight(const SimdModel& model, const KinematicModel& kinematics,
                 std::span<const double> from, std::span<const double> to, SimdScratch& scratch,
                 Extent& extent) {
  for (std::size_t i = 1; i < kinematics.bodies.size(); ++i) {
    const MovingBody& body = kinematics.bodies[i];
    SimdJointMotion& lane = scratch.motion[i];
    if (!slides(model.bodies[i].kind)) {
      if (!addStraightTurn(kinematics, body, from, to, lane, extent)) return false;
      continue;
    }
    if (!compileJoint(kinematics, body, from, to, scratch.slide)) return false;
    if (!addSlide(model, kinematics, i, scratch.slide, lane, extent)) return false;
  }
  return true;
}

/// Its data at the anchor is valid everywhere.
bool isLinear(const JointMotion& joint) {
  return joint.hasConstantRates() && joint.anchor == 0.0;
}

void setAccelerations(const JointMotion& joint, SimdJointMotion& lane) {
  lane.acceleration = static_cast<float>(joint.acceleration * kSingleOutward);
  lane.spinAcceleration = static_cast<float>(joint.spinAcceleration * kSingleOutward);
}

/// The joints of any path, over the whole motion.
bool addCurved(const SimdModel& model, const KinematicModel& kinematics,
               std::span<const JointMotion> joints, SimdScratch& scratch, Extent& extent) {
  for (std::size_t i = 1; i < joints.size(); ++i) {
    const JointMotion& joint = joints[i];
    const SimdJointKind kind = model.bodies[i].kind;
    SimdJointMotion& lane = scratch.motion[i];
    setAccelerations(joint, lane);
    if (!slides(kind)) {
      const MovingBody& body = kinematics.bodies[i];
      if (!(joint.largestAngle <= kLargestAngle)) return false;
      extent.withinLimits &= isWithin(body, joint.lowAngle, joint.highAngle);
      if (!addTurn(joint.angle, joint.angleRate, joint.spinSpeed, joint.spinSpeed, lane, extent))
        return false;
      continue;
    }
    // The axis that a floating joint turns about is the same in all lanes.
    if (floats(kind) && !isLinear(joint)) return false;
    if (!addSlide(model, kinematics, i, joint, lane, extent)) return false;
  }
  return true;
}

/// L6 and L7 of ERROR_MODEL.md.
bool setRounding(const SimdModel& model, const Extent& extent, SimdScratch& scratch) {
  scratch.withinLimits = extent.withinLimits;
  MotionExtent whole = extent.motion;
  whole.reach = model.reach + whole.slid;
  const double rounding = motionRounding(static_cast<double>(model.rounding), whole);
  scratch.rounding = static_cast<float>(rounding);
  return rounding < 1.0;
}

/// Takes the larger bounds.
void widen(const SimdJointMotion& other, SimdJointMotion& motion) {
  motion.spin = std::max(motion.spin, other.spin);
  motion.speed = std::max(motion.speed, other.speed);
  motion.slid = std::max(motion.slid, other.slid);
  motion.acceleration = std::max(motion.acceleration, other.acceleration);
  motion.spinAcceleration = std::max(motion.spinAcceleration, other.spinAcceleration);
}

}  // namespace

bool SimdMotion::compileAll() {
  Extent extent;
  const StraightPath* const straight = path_.asStraight();
  scratch_.curved = scratch_.block.given = straight == nullptr;
  const bool added = scratch_.curved ? path_.linearize(0.5, 0.5, joints_) &&
                                           addCurved(model_, kinematics_, joints_, scratch_, extent)
                                     : addStraight(model_, kinematics_, straight->from(),
                                                   straight->to(), scratch_, extent);
  if (!added) return false;
  // Lanes of a curve have bounds of their own.
  if (scratch_.curved) bound();
  extent_ = extent.motion;
  return setRounding(model_, extent, scratch_);
}

void SimdMotion::placeEighths() {
  if (placed_) return;
  placed_ = true;
  SimdBlock& block = scratch_.block;
  for (int lane = 0; lane < kLanes; ++lane) {
    block.time.lane[lane] = (2.0F * static_cast<float>(lane) + 1.0F) / (2.0F * kLanes);
    block.half.lane[lane] = 1.0F / (2.0F * kLanes);
  }
  if (scratch_.curved) linearizeLanes();
  detail::placeFrames(model_, scratch_.motion, model_.allBodies, block);
}

void SimdMotion::bound() {
  boundMotion(model_, scratch_);
  acceleration_ = 0.0F;
  for (const Row& row : scratch_.bounds[0].acceleration)
    for (const float value : row.lane) acceleration_ = std::max(acceleration_, value);
}

/// Values and rates of the joints at the middle of each lane, and bounds that hold in all.
void SimdMotion::linearizeLanes() {
  SimdBlock& block = scratch_.block;
  block.angleRate.resize(block.angle.size());
  block.slideRate.resize(block.slide.size());
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    linearizePart(path_, static_cast<double>(block.time.lane[lane]),
                  static_cast<double>(block.half.lane[lane]), joints_);
    for (std::size_t i = 1; i < joints_.size(); ++i) {
      SimdJointMotion& motion = scratch_.motion[i];
      SimdJointMotion own = motion;
      if (!isLinear(joints_[i])) {
        own = localMotion(i);
        if (lane == 0) motion = own;
        widen(own, motion);
      }
      const float since = isLinear(joints_[i]) ? block.time.lane[lane] : 0.0F;
      block.angle[i].lane[lane] = own.angle + since * own.angleRate;
      block.angleRate[i].lane[lane] = own.angleRate;
      for (std::size_t k = 0; k < 3; ++k) {
        block.slide[3 * i + k].lane[lane] = own.slide[k] + since * own.slideRate[k];
        block.slideRate[3 * i + k].lane[lane] = own.slideRate[k];
      }
    }
  }
  boundMotion(model_, scratch_);
  boundMotionOfLinks(model_, scratch_);
}

/// For a joint whose rate changes, in the interval of `joints`.
SimdJointMotion SimdMotion::localMotion(std::size_t body) const {
  const JointMotion& joint = joints_[body];
  SimdJointMotion own;
  setAccelerations(joint, own);
  own.angle = static_cast<float>(nearZero(joint.angle));
  own.angleRate = static_cast<float>(joint.angleRate);
  own.spin = static_cast<float>(joint.spinSpeed * kSingleOutward);
  own.speed = static_cast<float>(joint.speed * kSingleOutward);
  own.slid = static_cast<float>(joint.slid() * kSingleOutward);
  if (slides(model_.bodies[body].kind))
    setSlides(model_, kinematics_.bodies[body], body, joint, own);
  return own;
}

bool compileSimdState(const SimdModel& model, const KinematicModel& kinematics,
                      std::span<const double> q, SimdScratch& scratch) {
  Extent extent;
  return addStraight(model, kinematics, q, q, scratch, extent) &&
         setRounding(model, extent, scratch);
}

bool compileSimdStates(const SimdModel& model, const KinematicModel& kinematics,
                       std::span<const double> states, SimdScratch& scratch) {
  if (model.floats) return false;
  const auto dimension = static_cast<std::size_t>(kinematics.dimension);
  const std::size_t count = states.size() / dimension;
  Extent extent;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::span<const double> q =
        states.subspan((lane < count ? lane : 0) * dimension, dimension);
    Extent own;
    if (!addStraight(model, kinematics, q, q, scratch, own)) return false;
    extent.motion.largestAngle = std::max(extent.motion.largestAngle, own.motion.largestAngle);
    extent.motion.slid = std::max(extent.motion.slid, own.motion.slid);
    extent.motion.slideError = std::max(extent.motion.slideError, own.motion.slideError);
    extent.withinLimits &= own.withinLimits;
    for (std::size_t i = 1; i < model.bodies.size(); ++i) {
      scratch.block.angle[i].lane[lane] = scratch.motion[i].angle;
      for (std::size_t k = 0; k < 3; ++k)
        scratch.block.slide[3 * i + k].lane[lane] = scratch.motion[i].slide[k];
    }
  }
  return setRounding(model, extent, scratch);
}

}  // namespace swept::detail
