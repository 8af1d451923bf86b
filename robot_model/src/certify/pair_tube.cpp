// SPDX-License-Identifier: BSD-3-Clause
// The part of PairQuery that is about tubes: configurations q(t) + e, whose joints are off the
// motion by no more than PairModel::tube says.
//
// Lemma. For e in the tube and t = m + s, |s| <= h, let Q(u) = q(m + u s) + u e, 0 <= u <= 1. It
// leads from q(m) to q(t) + e. At u = 0 each joint has the rate s q'(m) + e, so a point of a link
// has the velocity s v(p) + sum over joints of e_j times what joint j does to it: ApproachError's
// linear part and spin, for e_j as large as the tolerance. Rates of joints are at most h times the
// motion's plus the tolerance, and accelerations h^2 times the motion's. With these L3 of
// ERROR_MODEL.md bounds |p''| over u, and half of that is what the first order neglects.
#include <algorithm>
#include <cmath>

#include "certify/pair_query.hpp"
#include "certify/waypoint_segments.hpp"
#include "kinematics/tube_motion.hpp"
#include "robot/joint_types.hpp"
#include "rounding/error_model.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Steps towards a contact. The first decides nearly always.
constexpr int kMostPushes = 4;

}  // namespace

void PairQuery::widenRanges() {
  detail::widenRanges(model_.kinematics, model_.tube, workspace_.motion);
}

/// The bounds of Q, over u.
void PairQuery::boundTubeMotion(double half) {
  workspace_.tubeMotion.resize(workspace_.motion.size());
  detail::boundTubeMotion(model_.kinematics, model_.tube, half, workspace_.motion,
                          workspace_.tubeMotion);
}

PointMotionBound PairQuery::tubeBound(int travel) {
  const MotionBoundSlot& slot = model_.motionBounds[static_cast<std::size_t>(travel)];
  const RobotGeometry& geometry = model_.robotGeometry[static_cast<std::size_t>(slot.geometry)];
  return pointMotionBound(model_.kinematics, geometry.levers.path, arms(geometry), slot.firstJoint,
                          workspace_.tubeMotion);
}

/// What joints of a geometry's path do to it, in the model frame: into the workspace's errors.
/// Returns m, what may be in any direction. `sign`: 1 for the second body of a pair, -1 for the
/// first.
double PairQuery::addErrors(int geometry, int motionBound, double sign) {
  const RobotGeometry& robot = model_.robotGeometry[static_cast<std::size_t>(geometry)];
  const std::vector<int>& path = robot.levers.path;
  const Vector3d at = center(geometry);
  double anywhere = 0.0;
  for (std::size_t i = model_.motionBounds[static_cast<std::size_t>(motionBound)].firstJoint;
       i < path.size(); ++i) {
    const JointTolerance& tolerance = model_.tube[static_cast<std::size_t>(path[i])];
    if (tolerance.rotation == 0.0 && tolerance.translation == 0.0) continue;
    const MovingBody& body = model_.kinematics.bodies[static_cast<std::size_t>(path[i])];
    const Isometry3d& frame = state(path[i]).world_from_body;
    if (body.type == JointType::Floating) {
      anywhere += tolerance.translation +
                  tolerance.rotation * ((at - frame.translation()).norm() + robot.radius);
      continue;
    }
    ApproachError& error = workspace_.errors.emplace_back();
    if (slidesWithinLimits(body.type)) {
      error.linear = sign * tolerance.translation * (frame.linear() * body.axis);
      continue;
    }
    const bool planar = body.type == JointType::Planar;
    if (planar) anywhere += tolerance.translation;
    const Vector3d axis = frame.linear() * (planar ? Vector3d(body.planarBasis.col(2)) : body.axis);
    const Vector3d spin = tolerance.rotation * axis;
    error.linear = sign * spin.cross(at - frame.translation());
    (sign < 0.0 ? error.spinA : error.spinB) = spin;
  }
  return anywhere;
}

/// The bounds of Q in place of those of the motion, with the pair's errors in the model frame.
const ApproachBound& PairQuery::withTube(const GeometryPair& pair, const ApproachBound& motion) {
  ApproachBound& bound = workspace_.tubeBound = motion;
  workspace_.errors.clear();
  PointMotionBound most = tubeBound(pair.motionBoundA);
  double anywhere = addErrors(pair.a, pair.motionBoundA, -1.0);
  if (pair.motionBoundB >= 0) {
    const PointMotionBound other = tubeBound(pair.motionBoundB);
    most.speed += other.speed;
    most.acceleration += other.acceleration;
    anywhere += addErrors(pair.b, pair.motionBoundB, 1.0);
  }
  bound.travel = most.speed * (1.0 + kVelocityRounding);
  bound.curvature = (0.5 * most.acceleration + anywhere) * (1.0 + kVelocityRounding);
  bound.required += velocityRounding(transformsOf(model_, pair)) * (bound.travel - motion.travel);
  bound.errors = workspace_.errors;
  return bound;
}

/// Takes the tube's bounds, and its errors in the first body's frame.
void PairQuery::takeTube(const Isometry3d& world_from_a, const ApproachBound& tube,
                         ApproachBound& bound) {
  const Eigen::Matrix3d a_from_world = world_from_a.linear().transpose();
  for (ApproachError& error : workspace_.errors) {
    error.linear = a_from_world * error.linear;
    error.spinA = a_from_world * error.spinA;
    error.spinB = a_from_world * error.spinB;
  }
  bound.required = tube.required;
  bound.travel = tube.travel;
  bound.curvature = tube.curvature;
  bound.errors = workspace_.errors;
}

/// Adds how much each value of the configuration, growing, moves the geometry's centre along
/// `push`, per rad or m.
void PairQuery::addGradient(int geometry, int motionBound, const Vector3d& push,
                            std::span<double> gradient) {
  const RobotGeometry& robot = model_.robotGeometry[static_cast<std::size_t>(geometry)];
  const std::vector<int>& path = robot.levers.path;
  const Vector3d at = center(geometry);
  for (std::size_t i = model_.motionBounds[static_cast<std::size_t>(motionBound)].firstJoint;
       i < path.size(); ++i) {
    const MovingBody& body = model_.kinematics.bodies[static_cast<std::size_t>(path[i])];
    const Isometry3d& frame = state(path[i]).world_from_body;
    const auto first = static_cast<std::size_t>(body.variable);
    const auto turned = [&](const Vector3d& axis) {
      return push.dot((frame.linear() * axis).cross(at - frame.translation()));
    };
    switch (body.type) {
      case JointType::Revolute:
      case JointType::Continuous:
        gradient[first] += body.multiplier * turned(body.axis);
        break;
      case JointType::Prismatic:
        gradient[first] += body.multiplier * push.dot(frame.linear() * body.axis);
        break;
      case JointType::Planar: {
        // Its own rotation is about the normal.
        const Vector3d local = (state(body.parent).world_from_body.linear() *
                                body.parent_from_joint.linear() * body.planarBasis)
                                   .transpose() *
                               push;
        gradient[first] += local.x();
        gradient[first + 1] += local.y();
        gradient[first + 2] += turned(body.planarBasis.col(2));
        break;
      }
      case JointType::Floating: {
        if (body.variable >= model_.kinematics.dimension) break;  // an obstacle
        const Vector3d local =
            (state(body.parent).world_from_body.linear() * body.parent_from_joint.linear())
                .transpose() *
            push;
        for (std::size_t k = 0; k < 3; ++k) gradient[first + k] += local[static_cast<int>(k)];
        break;
      }
      case JointType::Fixed:
        break;
    }
  }
}

namespace {

/// Moves the values as far along the gradient as the tube lets them. A floating joint keeps its
/// orientation.
void pushAlong(const CheckerModel& model, std::span<const double> gradient, std::span<double> q) {
  for (std::size_t i = 1; i < model.kinematics.bodies.size(); ++i) {
    const MovingBody& body = model.kinematics.bodies[i];
    // Mimicking joints follow their masters.
    if (body.joint < 0 || model.robot->joints()[static_cast<std::size_t>(body.joint)].mimic)
      continue;
    const JointTolerance& tolerance = model.tube[i];
    const auto first = static_cast<std::size_t>(body.variable);
    const auto pushOne = [&](std::size_t k, double most) {
      if (gradient[k] != 0.0) q[k] += std::copysign(most, gradient[k]);
    };
    if (slidesWithinLimits(body.type)) {
      const double before = q[first];
      pushOne(first, tolerance.translation);
      q[first] = std::clamp(q[first], std::min(before, model.kinematics.lower[first]),
                            std::max(before, model.kinematics.upper[first]));
      continue;
    }
    if (turns(body.type)) {
      pushOne(first, tolerance.rotation);
      continue;
    }
    const std::size_t count = body.type == JointType::Planar ? 2 : 3;
    double squared = 0.0;
    for (std::size_t k = 0; k < count; ++k) squared += gradient[first + k] * gradient[first + k];
    if (squared > 0.0) {
      // A little less, for the length that is made of the components rounds.
      const double share = tolerance.translation * (1.0 - 1e-12) / std::sqrt(squared);
      for (std::size_t k = 0; k < count; ++k) q[first + k] += share * gradient[first + k];
    }
    if (body.type == JointType::Planar) pushOne(first + 2, tolerance.rotation);
  }
}

}  // namespace

std::optional<Witness> PairQuery::tubeContact(std::uint32_t index, const PairAnswer& found) {
  if (!inTube_ || found.normal.isZero()) return std::nullopt;
  const GeometryPair& pair = model_.pair(index);
  const auto dimension = static_cast<std::size_t>(model_.kinematics.dimension);
  if (workspace_.besideMotion == nullptr || workspace_.besideMotion->version != workspace_.version)
    workspace_.besideMotion = std::make_unique<WorkspaceData>(model_);
  WorkspaceData& other = *workspace_.besideMotion;
  PairQuery beside(model_, other, Tube::None);
  std::vector<double>& q = workspace_.tubeState;
  std::vector<double>& gradient = workspace_.tubeGradient;
  PairQuery* at = this;
  Vector3d normal = found.normal;
  for (int step = 0; step < kMostPushes; ++step) {
    gradient.assign(dimension, 0.0);
    at->addGradient(pair.a, pair.motionBoundA, normal, gradient);
    if (pair.motionBoundB >= 0) at->addGradient(pair.b, pair.motionBoundB, -normal, gradient);
    q.resize(dimension);
    if (source_ != nullptr)
      source_->interpolate(workspace_.t, q);
    else
      std::ranges::copy(state_.first(dimension), q.begin());
    pushAlong(model_, gradient, q);
    if (step > 0 && std::ranges::equal(q, other.probe)) return std::nullopt;
    other.probe = q;
    if (!beside.startAt(fullConfiguration(model_, other.probe, other.from))) return std::nullopt;
    const PairAnswer answer = beside.prove(index, 0.0);
    if (answer.status == Separation::Contact) {
      Witness witness = beside.witness(index, workspace_.t, answer);
      witness.configuration = q;
      return witness;
    }
    if (answer.normal.isZero()) return std::nullopt;
    normal = answer.normal;
    at = &beside;
  }
  return std::nullopt;
}

}  // namespace swept::detail
