// SPDX-License-Identifier: BSD-3-Clause
#include "certify/pair_query.hpp"

#include <algorithm>
#include <cmath>

#include "kinematics/nested_motion_bounds.hpp"
#include "rounding/error_model.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Share of the motion tolerance left to the distance query, and to stopping before the tolerance.
constexpr double kQueryShare = 1.0 / 16.0;

}  // namespace

bool PairQuery::start(const JointPath& path) {
  if (!path.linearize(0.5, 0.5, workspace_.motion)) return false;
  if (inTube_) widenRanges();
  ++workspace_.motionStamp;
  ++workspace_.boundStamp;
  bool curved = false;
  CarriedRounding& most = workspace_.mostCarried;
  most = {};
  double slid = 0.0;  // of all joints: what is no number shows in a sum
  for (std::size_t i = 1; i < workspace_.motion.size(); ++i) {
    const JointMotion& joint = workspace_.motion[i];
    const CarriedRounding& own = workspace_.carried[i] =
        carriedRounding(workspace_.carried[model_.kinematics.bodies[i].parent], joint);
    most.slid = std::max(most.slid, own.slid);
    most.angleError = std::max(most.angleError, own.angleError);
    most.slideError = std::max(most.slideError, own.slideError);
    slid += joint.slid() + joint.speed;
    curved = curved || !joint.hasConstantRates();
  }
  // The SIMD tier linearizes any other path than a straight one in the same place.
  path_ = curved || path.asStraight() == nullptr ? &path : nullptr;
  source_ = &path;
  return slid < kLargestNorm;
}

bool PairQuery::startAt(std::span<const double> q) {
  if (!start(StraightPath(model_.kinematics, q, q))) return false;
  source_ = nullptr;
  state_ = q;
  moveTo(0.0, 0.0);
  return true;
}

void PairQuery::moveTo(double t, double half) {
  if (path_ != nullptr) {
    linearizePart(*path_, t, half, workspace_.motion);
    if (inTube_) widenRanges();
    ++workspace_.boundStamp;
  }
  if (inTube_) boundTubeMotion(half);
  workspace_.t = t;
  ++workspace_.stamp;
  workspace_.stateStamps[0] = workspace_.stamp;
}

const BodyState& PairQuery::state(int body) {
  if (workspace_.stateStamps[body] != workspace_.stamp) {
    state(model_.kinematics.bodies[body].parent);
    evaluateBody(model_.kinematics, workspace_.motion, workspace_.t, body, workspace_.states);
    workspace_.stateStamps[body] = workspace_.stamp;
  }
  return workspace_.states[body];
}

std::span<const double> PairQuery::arms(const RobotGeometry& geometry) {
  const LeverArms& levers = geometry.levers;
  if (!levers.vary) return levers.arms;
  const std::span<double> own = std::span(workspace_.arms).first(levers.path.size());
  motionArms(model_.kinematics, geometry.body, geometry.center, geometry.radius, workspace_.motion,
             own);
  return own;
}

const PointMotionBound& PairQuery::bound(int travel) {
  if (!workspace_.nestedMotionBounds.empty()) return nestedBound(model_.motionBounds[travel]);
  if (workspace_.motionBoundStamps[travel] != workspace_.boundStamp) {
    const MotionBoundSlot& slot = model_.motionBounds[travel];
    const RobotGeometry& geometry = model_.robotGeometry[slot.geometry];
    workspace_.motionBounds[travel] =
        pointMotionBound(model_.kinematics, geometry.levers.path, arms(geometry), slot.firstJoint,
                         workspace_.motion);
    workspace_.motionBoundStamps[travel] = workspace_.boundStamp;
  }
  return workspace_.motionBounds[travel];
}

const PointMotionBound& PairQuery::nestedBound(const MotionBoundSlot& slot) {
  std::vector<PointMotionBound>& bounds = workspace_.nestedMotionBounds[slot.geometry];
  if (workspace_.motionBoundStamps[slot.geometry] != workspace_.boundStamp) {
    const RobotGeometry& geometry = model_.robotGeometry[slot.geometry];
    nestedMotionBounds(model_.kinematics, geometry.levers.path, arms(geometry), workspace_.motion,
                       bounds);
    workspace_.motionBoundStamps[slot.geometry] = workspace_.boundStamp;
  }
  return bounds[slot.firstJoint];
}

Vector3d& PairQuery::hint(std::uint32_t pair) {
  if (workspace_.hintStamps[pair] != workspace_.motionStamp) {
    workspace_.hints[pair].setZero();
    workspace_.hintStamps[pair] = workspace_.motionStamp;
  }
  return workspace_.hints[pair];
}

const Vector3d& PairQuery::center(int geometry) {
  WorkspaceData::Placed& placed = workspace_.placed[geometry];
  if (placed.stamp != workspace_.stamp) {
    const RobotGeometry& robot = model_.robotGeometry[geometry];
    placed.center = state(robot.body).world_from_body * robot.center;
    placed.stamp = workspace_.stamp;
    placed.posed = false;
  }
  return placed.center;
}

const Isometry3d& PairQuery::pose(int geometry) {
  center(geometry);
  WorkspaceData::Placed& placed = workspace_.placed[geometry];
  if (!placed.posed) {
    const RobotGeometry& robot = model_.robotGeometry[geometry];
    placed.world_from_shape = state(robot.body).world_from_body * robot.body_from_shape;
    placed.posed = true;
  }
  return placed.world_from_shape;
}

/// The part that translations and large values add. Each geometry has the translations of the
/// joints that carry it. The rest is known at compile time.
double PairQuery::rounding(const GeometryPair& pair) const {
  const double perMetre = tolerance::kRoundingPerJoint * (transformsOf(model_, pair) + 2.0);
  const auto carried = [&](int geometry) {
    const RobotGeometry& robot = model_.robotGeometry[geometry];
    const CarriedRounding& own = workspace_.carried[robot.body];
    return perMetre * own.slid + own.angleError * (robot.levers.spanAtRest + own.slid) +
           own.slideError;
  };
  return pair.rounding + carried(pair.a) + (pair.self ? carried(pair.b) : 0.0);
}

double PairQuery::largestRounding() const {
  const CarriedRounding& most = workspace_.mostCarried;
  const double perMetre = tolerance::kRoundingPerJoint * (model_.largestTransforms + 2.0);
  return model_.largestRounding + 2.0 * perMetre * most.slid +
         most.angleError * (model_.largestSpan + 2.0 * most.slid) + 2.0 * most.slideError;
}

double PairQuery::travel(const GeometryPair& pair, double half) {
  double speed = bound(pair.motionBoundA).speed;
  if (pair.motionBoundB >= 0) speed += bound(pair.motionBoundB).speed;
  return half * speed * (1.0 + kVelocityRounding);
}

Aabb PairQuery::ballBox(int geometry, double half) {
  // The geometry has pairs with the world, whose motion bound is in the model frame.
  const GeometryPair& pair = model_.pair(model_.firstWorldPair[geometry]);
  const double tube = inTube_ ? pair.tube : 0.0;
  const double reach = model_.robotGeometry[geometry].radius + travel(pair, half) + tube +
                       model_.largestMargin + largestRounding();
  return boxAround(geometry, reach);
}

Aabb PairQuery::ballBox(const GeometryPair& pair, double half) {
  const double radius = model_.robotGeometry[pair.a].radius;
  return boxAround(pair.a, radius + travel(pair, half) + rounding(pair));
}

Aabb PairQuery::boxAround(int geometry, double reach) {
  const Vector3d all = Vector3d::Constant(reach * (1.0 + kVelocityRounding));
  const Vector3d& middle = center(geometry);
  // A NaN box overlaps nothing, so return an unbounded one.
  if (!(reach < kLargestNorm)) {
    const Vector3d everywhere = Vector3d::Constant(std::numeric_limits<double>::infinity());
    return {-everywhere, everywhere};
  }
  return {middle - all, middle + all};
}

Vector3d PairQuery::relativeVelocity(const GeometryPair& pair) {
  const BodyState& reference = state(pair.reference);
  const auto relative = [&](int geometry) -> Vector3d {
    const BodyState& own = state(model_.robotGeometry[geometry].body);
    return own.linear - reference.linear +
           (own.angular - reference.angular).cross(center(geometry));
  };
  Vector3d velocity = -relative(pair.a);
  if (pair.self) velocity += relative(pair.b);
  return velocity;
}

const Shape& PairQuery::shapeOfB(const GeometryPair& pair) const {
  return pair.self ? model_.robotGeometry[pair.b].shape : model_.worldGeometry[pair.b].shape;
}

Isometry3d PairQuery::poseOfB(const GeometryPair& pair) {
  return pair.self ? pose(pair.b) : model_.worldGeometry[pair.b].world_from_shape;
}

double PairQuery::coarseDistance(const GeometryPair& pair) {
  const double radius = model_.robotGeometry[pair.a].radius;
  if (pair.self) {
    const double other = model_.robotGeometry[pair.b].radius;
    return (center(pair.a) - center(pair.b)).norm() - radius - other - rounding(pair);
  }
  const WorldGeometry& world = model_.worldGeometry[pair.b];
  const Vector3d local = world.box_from_world * center(pair.a);
  const Vector3d outside = (local.cwiseAbs() - world.halfExtents).cwiseMax(Vector3d::Zero());
  return outside.norm() - radius - rounding(pair);
}

double PairQuery::gapOfBounds(const GeometryPair& pair, Vector3d& direction) {
  double gap = -model_.robotGeometry[pair.a].radius;
  if (pair.self) {
    direction = center(pair.b) - center(pair.a);
    gap -= model_.robotGeometry[pair.b].radius;
  } else {
    const WorldGeometry& world = model_.worldGeometry[pair.b];
    const Vector3d local = world.box_from_world * center(pair.a);
    const Vector3d outside = (local.cwiseAbs() - world.halfExtents).cwiseMax(Vector3d::Zero());
    direction =
        -(world.box_from_world.linear().transpose() *
          Vector3d(std::copysign(outside.x(), local.x()), std::copysign(outside.y(), local.y()),
                   std::copysign(outside.z(), local.z())));
  }
  return gap + direction.norm();
}

double PairQuery::coarseBound(const GeometryPair& pair, double half) {
  const double travelled = travel(pair, half);
  Vector3d direction;
  const double gap = gapOfBounds(pair, direction);
  const double lower =
      gap - rounding(pair) - velocityRounding(transformsOf(model_, pair)) * travelled;
  if (!(gap > 0.0)) return lower - travelled;
  const double directed =
      half * std::abs(direction.dot(relativeVelocity(pair))) / direction.norm() +
      approach(pair, half, 0.0).curvature;
  return lower - std::min(travelled, directed);
}

/// Compares the containing balls (and the world geometry's box) along the direction between them. A
/// ball's own spin does not bring it closer. `alone`: the bound of the motion without the tube,
/// whose errors are in the model frame here.
PairQuery::Coarse PairQuery::compareBounds(const GeometryPair& pair, const ApproachBound& bound,
                                           const ApproachBound& alone, const Vector3d& velocity,
                                           Vector3d& towards) {
  Vector3d direction;
  const double gap = gapOfBounds(pair, direction);
  const double norm = direction.norm();
  if (!(norm > 0.0) || !(gap > bound.required)) return Coarse::Open;
  towards = direction / norm;
  const double moved = std::abs(direction.dot(velocity)) / norm;
  double directed = moved + bound.curvature;
  for (const ApproachError& error : bound.errors) directed += std::abs(towards.dot(error.linear));
  if (gap > bound.required + std::min(bound.travel, directed)) return Coarse::Apart;
  // The bodies are apart now, but even their centres come closer than this: only shorter intervals
  // help.
  const double approach = std::min(alone.travel, moved + alone.curvature);
  const bool hopeless =
      approach > norm + model_.robotGeometry[pair.a].radius && approach > tolerance_;
  return hopeless ? Coarse::TooFast : Coarse::Open;
}

void PairQuery::relativeMotion(const GeometryPair& pair, double half,
                               const Isometry3d& world_from_a, const Vector3d& velocity,
                               ApproachBound& bound) {
  const Vector3d& reference = state(pair.reference).angular;
  const RobotGeometry& a = model_.robotGeometry[pair.a];
  const Eigen::Matrix3d a_from_world = world_from_a.linear().transpose();
  bound.linear = a_from_world * velocity;
  bound.spinA = a_from_world * (half * (state(a.body).angular - reference));
  bound.ballA = {a_from_world * (center(pair.a) - world_from_a.translation()), a.radius};
  if (!pair.self) return;
  const RobotGeometry& b = model_.robotGeometry[pair.b];
  bound.spinB = a_from_world * (half * (state(b.body).angular - reference));
  bound.ballB = {a_from_world * (center(pair.b) - world_from_a.translation()), b.radius};
}

ApproachBound PairQuery::approach(const GeometryPair& pair, double half, double separation) {
  ApproachBound bound;
  bound.travel = travel(pair, half);
  double acceleration = this->bound(pair.motionBoundA).acceleration;
  if (pair.motionBoundB >= 0) acceleration += this->bound(pair.motionBoundB).acceleration;
  bound.curvature = 0.5 * half * half * acceleration * (1.0 + kVelocityRounding);
  bound.required =
      separation + rounding(pair) + velocityRounding(transformsOf(model_, pair)) * bound.travel;
  return bound;
}

PairAnswer PairQuery::prove(std::uint32_t index, double half) {
  const GeometryPair& pair = model_.pair(index);
  PairAnswer answer;
  ApproachBound bound = approach(pair, half, pair.margin);
  const Vector3d velocity = half * relativeVelocity(pair);
  const ApproachBound& whole = inTube_ ? withTube(pair, bound) : bound;
  answer.travel = bound.travel;
  const Coarse coarse = compareBounds(pair, whole, bound, velocity, answer.normal);
  if (coarse != Coarse::Open) {
    answer.status = coarse == Coarse::Apart ? Separation::Separated : Separation::Unproven;
    answer.culled = true;
    return answer;
  }

  const Isometry3d& world_from_a = pose(pair.a);
  const Isometry3d world_from_b = poseOfB(pair);
  relativeMotion(pair, half, world_from_a, velocity, bound);
  answer.travel = bound.most() - bound.required;
  SeparationQuery query;
  query.approach = bound;
  if (inTube_) takeTube(world_from_a, whole, query.approach);
  query.contact = pair.margin;
  // A state cannot be divided, so use the best tolerance.
  query.tolerance = half > 0.0 ? kQueryShare * tolerance_ : tolerance::kDistance;
  query.guess = hint(index);
  query.thorough = answer.travel <= tolerance_;
  const SeparationResult result = separate(model_.robotGeometry[pair.a].shape, shapeOfB(pair),
                                           world_from_a.inverse() * world_from_b, query);
  hint(index) = result.normal;
  answer.status = result.status;
  answer.normal = world_from_a.linear() * result.normal;
  answer.pointA = world_from_a * result.pointA;
  answer.pointB = world_from_a * result.pointB;
  return answer;
}

PairDistance PairQuery::measure(const GeometryPair& pair, double enough, double accuracy) {
  const Isometry3d& world_from_a = pose(pair.a);
  DistanceOptions options;
  options.enough = enough + rounding(pair);
  options.tolerance = accuracy;
  const DistanceResult found = distance(model_.robotGeometry[pair.a].shape, shapeOfB(pair),
                                        world_from_a.inverse() * poseOfB(pair), options);
  PairDistance result;
  result.lower = std::max(0.0, found.lower - rounding(pair));
  result.upper = found.upper;
  result.pointA = world_from_a * found.pointA;
  result.pointB = world_from_a * found.pointB;
  result.normal = world_from_a.linear() * found.normal;
  return result;
}

HullSeparation PairQuery::hullBound(const GeometryPair& pair, double half,
                                    const Vector3d& towards) {
  const Isometry3d& world_from_a = pose(pair.a);
  ApproachBound motion = approach(pair, half, 0.0);
  relativeMotion(pair, half, world_from_a, half * relativeVelocity(pair), motion);
  Vector3d direction = towards;
  if (direction.isZero(0.0)) gapOfBounds(pair, direction);
  HullSeparation found = hullSeparation(model_.robotGeometry[pair.a].shape, shapeOfB(pair),
                                        world_from_a.inverse() * poseOfB(pair), motion,
                                        world_from_a.linear().transpose() * direction);
  found.atMiddle -= rounding(pair);
  found.least -= motion.required;
  return found;
}

bool PairQuery::staysBeyond(const GeometryPair& pair, double half, double distance,
                            const Vector3d& guess, double accuracy) {
  const Isometry3d& world_from_a = pose(pair.a);
  SeparationQuery query;
  query.approach = approach(pair, half, distance);
  relativeMotion(pair, half, world_from_a, half * relativeVelocity(pair), query.approach);
  query.guess = world_from_a.linear().transpose() * guess;
  query.tolerance = accuracy;
  query.thorough = query.approach.most() - query.approach.required <= accuracy;
  const SeparationResult result = separate(model_.robotGeometry[pair.a].shape, shapeOfB(pair),
                                           world_from_a.inverse() * poseOfB(pair), query);
  return result.status == Separation::Separated;
}

SignedClearance PairQuery::measureSigned(const GeometryPair& pair, double accuracy) {
  const Isometry3d& world_from_a = pose(pair.a);
  const SignedDistanceResult found =
      signedDistance(model_.robotGeometry[pair.a].shape, shapeOfB(pair),
                     world_from_a.inverse() * poseOfB(pair), accuracy);
  const double lower = found.lower - rounding(pair);
  // NaN gives no bound.
  return {lower <= found.upper ? lower : -std::numeric_limits<double>::infinity(), found.upper,
          world_from_a * found.pointA, world_from_a * found.pointB,
          world_from_a.linear() * found.normal};
}

Vector3d PairQuery::velocity(const GeometryPair& pair, const Vector3d& pointA,
                             const Vector3d& pointB) {
  const BodyState& a = state(model_.robotGeometry[pair.a].body);
  Vector3d velocity = -(a.linear + a.angular.cross(pointA));
  if (pair.self) {
    const BodyState& b = state(model_.robotGeometry[pair.b].body);
    velocity += b.linear + b.angular.cross(pointB);
  }
  return velocity;
}

Witness PairQuery::witness(std::uint32_t index, double t, const PairAnswer& answer) const {
  const GeometryPair& pair = model_.pair(index);
  Witness witness;
  witness.t = t;
  witness.bodyA = model_.nameOfA(pair);
  witness.bodyB = model_.nameOfB(pair);
  witness.selfPair = model_.isSelfPair(pair);
  witness.pointA = answer.pointA;
  witness.pointB = answer.pointB;
  witness.distance = (answer.pointB - answer.pointA).norm();
  witness.margin = pair.margin;
  return witness;
}

}  // namespace swept::detail
