// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/motion_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "rounding/error_model.hpp"
#include "swept/core/axis_frame.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

/// Product of two quaternions x, y, z, w, as given and summed in the order of OMPL's SO3StateSpace:
/// between opposite orientations its rounding decides which way round is taken.
double dot(const double* a, const double* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/// The rotation from one orientation to another, or to the same with the other sign.
Vector3d rotationVector(const Quaterniond& from, const Quaterniond& to, bool negated) {
  Quaterniond relative = to * from.conjugate();
  if (negated) relative.coeffs() = -relative.coeffs();
  const double sine = relative.vec().norm();
  if (!(sine > 0.0)) return Vector3d::Zero();
  return (2.0 * std::atan2(sine, relative.w()) / sine) * relative.vec();
}

/// `since`: t minus the anchor.
Matrix3d turnOf(const Vector3d& axis, const JointMotion& motion, double since) {
  return Eigen::AngleAxisd(motion.angle + since * motion.angleRate, axis).toRotationMatrix();
}

/// `since`: as above.
Isometry3d jointTransform(const MovingBody& body, const JointMotion& motion, double since) {
  Isometry3d joint_from_body = Isometry3d::Identity();
  joint_from_body.translation() = motion.translation + since * motion.rate;
  if (body.type == JointType::Revolute || body.type == JointType::Continuous ||
      body.type == JointType::Planar) {
    const Vector3d axis = body.type == JointType::Planar ? body.planarBasis.col(2) : body.axis;
    joint_from_body.linear() = turnOf(axis, motion, since);
  } else if (body.type == JointType::Floating) {
    const double turning = motion.spin.norm();  // at the anchor; the bound may be larger
    const Quaterniond turned =
        turning > 0.0 ? Quaterniond(Eigen::AngleAxisd(since * turning, motion.spin / turning)) *
                            motion.rotation
                      : motion.rotation;
    joint_from_body.linear() = turned.normalized().toRotationMatrix();
  }
  return joint_from_body;
}

/// Pose of a joint outside the group, whose value does not change.
Isometry3d heldTransform(const Robot& robot, const Joint& joint, const Eigen::VectorXd& reference) {
  MovingBody body;
  body.type = joint.type;
  body.axis = joint.axis;
  body.planarBasis = axisFrame(joint.axis);
  JointMotion motion;
  const Joint& source = joint.mimic ? robot.joints()[joint.mimic->master] : joint;
  if (joint.type == JointType::Fixed || source.firstVariable < 0) return Isometry3d::Identity();
  const double* values = reference.data() + source.firstVariable;
  const double value =
      joint.mimic ? joint.mimic->multiplier * values[0] + joint.mimic->offset : values[0];
  switch (joint.type) {
    case JointType::Prismatic:
      motion.translation = value * joint.axis;
      break;
    case JointType::Revolute:
    case JointType::Continuous:
      motion.angle = value;
      break;
    case JointType::Planar:
      motion.translation = body.planarBasis * Vector3d(values[0], values[1], 0.0);
      motion.angle = values[2];
      break;
    case JointType::Floating:
      motion.translation = {values[0], values[1], values[2]};
      motion.rotation = Quaterniond(values[6], values[3], values[4], values[5]).normalized();
      break;
    case JointType::Fixed:
      break;
  }
  return jointTransform(body, motion, 0.0);
}

/// The chain with one more fixed joint, whose frame is `joint` and whose child's frame is `child`.
FixedJointChain withHeldJoint(FixedJointChain fixedChain, const Robot& robot, const Joint& held,
                              const Eigen::VectorXd& reference, const Isometry3d& joint,
                              const Isometry3d& child) {
  fixedChain.transforms += 1.0;
  fixedChain.farthest =
      std::max({fixedChain.farthest, joint.translation().norm(), child.translation().norm()});
  const Joint& source = held.mimic ? robot.joints()[held.mimic->master] : held;
  if (held.type == JointType::Fixed || source.firstVariable < 0) return fixedChain;
  const bool planar = held.type == JointType::Planar;
  double value = std::abs(reference[source.firstVariable + (planar ? 2 : 0)]);
  if (held.mimic) value = std::abs(held.mimic->multiplier) * value + std::abs(held.mimic->offset);
  if (held.type == JointType::Prismatic) fixedChain.farthest = std::max(fixedChain.farthest, value);
  if (turns(held.type) || planar) fixedChain.transforms += value / kOrdinary;
  return fixedChain;
}

MovingBody moveJoint(const Robot& robot, const Joint& joint, const Group& group) {
  MovingBody body;
  body.type = joint.type;
  body.axis = joint.axis;
  body.planarBasis = axisFrame(joint.axis);
  const Joint& source = joint.mimic ? robot.joints()[joint.mimic->master] : joint;
  if (joint.mimic) {
    body.multiplier = joint.mimic->multiplier;
    body.offset = joint.mimic->offset;
  }
  const auto found =
      std::find(group.variables.begin(), group.variables.end(), source.firstVariable);
  body.variable = static_cast<int>(found - group.variables.begin());
  const Variable& variable = robot.variables()[source.firstVariable];
  const double atLower = body.multiplier * variable.lower + body.offset;
  const double atUpper = body.multiplier * variable.upper + body.offset;
  // compileMotion lets values pass their limits by this much: the allowance of isWithin() plus, for
  // sliding joints, which are refused beyond, the rounding of such a value.
  if (body.type == JointType::Prismatic)
    body.valueRounding =
        kValueRounding *
        (std::abs(body.multiplier) * std::max(std::abs(variable.lower), std::abs(variable.upper)) +
         std::abs(body.offset));
  const double slack = std::abs(body.multiplier) * tolerance::kLimit + body.valueRounding;
  body.lower = std::min(atLower, atUpper) - slack;
  body.upper = std::max(atLower, atUpper) + slack;
  return body;
}

bool moves(const Robot& robot, const Joint& joint, const Group& group) {
  if (joint.type == JointType::Fixed) return false;
  const Joint& source = joint.mimic ? robot.joints()[joint.mimic->master] : joint;
  return std::find(group.variables.begin(), group.variables.end(), source.firstVariable) !=
         group.variables.end();
}

}  // namespace

bool hasDirection(const double* quaternion) {
  const double length = Eigen::Map<const Eigen::Vector4d>(quaternion).norm();
  return length > 1e-6 && std::isfinite(length);
}

KinematicModel compileKinematics(const Robot& robot, const Group& group,
                                 const Eigen::VectorXd& reference) {
  KinematicModel model;
  model.bodies.emplace_back();
  model.dimension = static_cast<int>(group.variables.size());
  model.fullDimension = model.dimension;
  for (const int index : group.variables) {
    const Variable& variable = robot.variables()[index];
    model.cyclic.push_back(variable.cyclic);
    model.lower.push_back(variable.lower);
    model.upper.push_back(variable.upper);
  }
  const std::size_t links = robot.links().size();
  model.bodyOfLink.assign(links, 0);
  model.body_from_link.assign(links, Isometry3d::Identity());
  model.fixedChainOfLink.assign(links, FixedJointChain{});
  for (const Joint& joint : robot.joints()) {
    const int parentBody = joint.parentLink < 0 ? 0 : model.bodyOfLink[joint.parentLink];
    const Isometry3d parentPose =
        joint.parentLink < 0 ? Isometry3d::Identity() : model.body_from_link[joint.parentLink];
    const Isometry3d body_from_joint = parentPose * joint.parent_from_joint;
    const FixedJointChain before =
        joint.parentLink < 0 ? FixedJointChain{} : model.fixedChainOfLink[joint.parentLink];
    if (moves(robot, joint, group)) {
      MovingBody body = moveJoint(robot, joint, group);
      body.parent = parentBody;
      body.joint = static_cast<int>(&joint - robot.joints().data());
      body.parent_from_joint = body_from_joint;
      body.fixedChain = before;
      model.bodyOfLink[joint.childLink] = static_cast<int>(model.bodies.size());
      model.bodies.push_back(body);
    } else {
      model.bodyOfLink[joint.childLink] = parentBody;
      model.body_from_link[joint.childLink] =
          body_from_joint * heldTransform(robot, joint, reference);
      model.fixedChainOfLink[joint.childLink] = withHeldJoint(
          before, robot, joint, reference, body_from_joint, model.body_from_link[joint.childLink]);
    }
  }
  return model;
}

int addAttachedFrame(KinematicModel& model, int body, const Isometry3d& body_from_frame) {
  MovingBody frame;
  frame.parent = body;
  frame.parent_from_joint = body_from_frame;
  // Whatever the first value, the joint's is zero.
  frame.variable = 0;
  frame.multiplier = 0.0;
  model.bodies.push_back(frame);
  return static_cast<int>(model.bodies.size()) - 1;
}

int addObstacleFrames(KinematicModel& model, std::size_t count) {
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  constexpr int kPose = 8;  // with the magnitude
  const int first = model.firstObstacle = static_cast<int>(model.bodies.size());
  if (count == 0) return first;
  model.cyclic.push_back(0);
  model.lower.push_back(-kUnlimited);
  model.upper.push_back(kUnlimited);
  ++model.dimension;
  model.fullDimension = model.dimension;
  for (std::size_t i = 0; i < count; ++i) {
    MovingBody frame;
    frame.parent = 0;
    frame.type = JointType::Floating;
    frame.variable = model.fullDimension;
    model.bodies.push_back(frame);
    model.fullDimension += kPose;
  }
  return first;
}

namespace {

bool compileFloating(const double* from, const double* to, JointMotion& motion) {
  const Vector3d start(from[0], from[1], from[2]);
  const Vector3d end(to[0], to[1], to[2]);
  if (!hasDirection(from + 3) || !hasDirection(to + 3)) return false;
  Quaterniond first(from[6], from[3], from[4], from[5]);
  Quaterniond second(to[6], to[3], to[4], to[5]);
  first.normalize();
  second.normalize();
  motion.translation = start;
  motion.rate = end - start;
  motion.rotation = first;
  motion.spin = rotationVector(first, second, dot(from + 3, to + 3) < 0.0);
  motion.maxTranslation = std::max(start.norm(), end.norm());
  motion.speed = motion.rate.norm();
  motion.spinSpeed = motion.spin.norm();
  return true;
}

}  // namespace

bool compileJoint(const KinematicModel& model, const MovingBody& body, std::span<const double> from,
                  std::span<const double> to, JointMotion& motion) {
  motion = JointMotion{};
  const double* q0 = from.data() + body.variable;
  const double* q1 = to.data() + body.variable;
  switch (body.type) {
    case JointType::Revolute:
    case JointType::Continuous: {
      const double difference =
          model.cyclic[body.variable] ? cyclicDifference(*q0, *q1) : *q1 - *q0;
      motion.angle = body.multiplier * *q0 + body.offset;
      motion.angleRate = body.multiplier * difference;
      motion.spin = motion.angleRate * body.axis;
      motion.spinSpeed = motion.spin.norm();
      motion.lowAngle = std::min(motion.angle, motion.angle + motion.angleRate);
      motion.highAngle = std::max(motion.angle, motion.angle + motion.angleRate);
      motion.largestAngle = std::abs(body.multiplier) *
                                (std::max(std::abs(*q0), std::abs(*q1)) + std::abs(difference)) +
                            std::abs(body.offset);
      break;
    }
    case JointType::Prismatic: {
      // A prismatic joint may mimic a cyclic one and then moves the way that its master does.
      const double difference =
          model.cyclic[body.variable] ? cyclicDifference(*q0, *q1) : *q1 - *q0;
      const double start = body.multiplier * *q0 + body.offset;
      const double end = start + body.multiplier * difference;
      if (!(std::min(start, end) >= body.lower && std::max(start, end) <= body.upper)) return false;
      motion.translation = start * body.axis;
      motion.rate = (body.multiplier * difference) * body.axis;
      motion.speed = motion.rate.norm();
      const double largest = std::abs(body.multiplier) *
                                 (std::max(std::abs(*q0), std::abs(*q1)) + std::abs(difference)) +
                             std::abs(body.offset);
      motion.low = std::min(start, end);
      motion.high = std::max(start, end);
      motion.slideError = kValueRounding * std::max(0.0, largest - kOrdinary * motion.slid());
      break;
    }
    case JointType::Planar:
      motion.translation = body.planarBasis * Vector3d(q0[0], q0[1], 0.0);
      motion.rate = body.planarBasis * Vector3d(q1[0] - q0[0], q1[1] - q0[1], 0.0);
      motion.angle = q0[2];
      motion.angleRate = cyclicDifference(q0[2], q1[2]);
      motion.largestAngle = std::max(std::abs(q0[2]), std::abs(q1[2])) + std::abs(motion.angleRate);
      motion.spin = motion.angleRate * body.planarBasis.col(2);
      motion.maxTranslation = std::max(std::hypot(q0[0], q0[1]), std::hypot(q1[0], q1[1]));
      motion.speed = motion.rate.norm();
      motion.spinSpeed = motion.spin.norm();
      break;
    case JointType::Floating:
      if (!compileFloating(q0, q1, motion)) return false;
      // For an obstacle between waypoints that may be far away. Lemma: the value, the share and its
      // product round, for each of three coordinates, by less than 14 parts in 2^53.
      if (body.variable >= model.dimension) {
        const double largest = 4.0 * std::max(q0[7], q1[7]);
        motion.slideError =
            kValueRounding * std::max(0.0, largest - kOrdinary * motion.maxTranslation);
      }
      break;
    case JointType::Fixed:
      break;
  }
  return true;
}

bool compileMotion(const KinematicModel& model, std::span<const double> from,
                   std::span<const double> to, std::span<JointMotion> motion) {
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(from.begin(), from.end(), finite)) return false;
  if (!std::all_of(to.begin(), to.end(), finite)) return false;
  for (std::size_t i = 1; i < motion.size(); ++i) {
    if (!compileJoint(model, model.bodies[i], from, to, motion[i])) return false;
  }
  return true;
}

CarriedRounding carriedRounding(const CarriedRounding& before, const JointMotion& joint) {
  return {before.slid + joint.slid(),
          before.angleError + kValueRounding * std::max(0.0, joint.largestAngle - kOrdinary),
          before.slideError + joint.slideError};
}

BodyState bodyAt(const MovingBody& body, const JointMotion& joint, double t,
                 const BodyState& parent) {
  const auto& parentAxes = parent.world_from_body.linear();
  const Matrix3d axes = parentAxes * body.parent_from_joint.linear();
  const Vector3d origin =
      parentAxes * body.parent_from_joint.translation() + parent.world_from_body.translation();
  BodyState state;
  const double since = t - joint.anchor;
  const Vector3d spin = axes * joint.spin;
  state.angular = parent.angular + spin;
  // The joint rotates the body about its own moving origin o: v += rate + spin x (p - o).
  if (turns(body.type)) {
    // Most joints only turn: what slides is zero. This gives the same bits.
    state.world_from_body.linear() = axes * turnOf(body.axis, joint, since);
    state.world_from_body.translation() = origin;
    state.linear = parent.linear - spin.cross(origin);
  } else {
    const Isometry3d joint_from_body = jointTransform(body, joint, since);
    state.world_from_body.linear() = axes * joint_from_body.linear();
    state.world_from_body.translation() = axes * joint_from_body.translation() + origin;
    state.linear =
        parent.linear + axes * joint.rate - spin.cross(state.world_from_body.translation());
  }
  return state;
}

void evaluateBody(const KinematicModel& model, std::span<const JointMotion> motion, double t,
                  int body, std::span<BodyState> states) {
  const MovingBody& moving = model.bodies[body];
  states[body] = bodyAt(moving, motion[body], t, states[moving.parent]);
}

void interpolateMotion(const KinematicModel& model, std::span<const double> from,
                       std::span<const double> to, double t, std::span<double> q) {
  for (int i = 0; i < model.dimension; ++i) {
    if (!model.cyclic[i]) {
      q[i] = from[i] + t * (to[i] - from[i]);
      continue;
    }
    const double value = from[i] + t * cyclicDifference(from[i], to[i]);
    q[i] = std::abs(value) <= kPi ? value : std::remainder(value, 2.0 * kPi);
  }
  interpolateOrientations(model, from, to, t, q);
}

void interpolateOrientations(const KinematicModel& model, std::span<const double> from,
                             std::span<const double> to, double t, std::span<double> q) {
  for (const MovingBody& body : model.bodies) {
    if (body.type != JointType::Floating || body.variable >= model.dimension) continue;
    JointMotion motion;
    if (!compileFloating(from.data() + body.variable, to.data() + body.variable, motion)) continue;
    const Quaterniond turned(jointTransform(body, motion, t).linear());
    for (int i = 0; i < 4; ++i) q[body.variable + 3 + i] = turned.coeffs()[i];
  }
}

}  // namespace swept::detail
