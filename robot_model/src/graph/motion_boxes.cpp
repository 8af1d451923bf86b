// SPDX-License-Identifier: BSD-3-Clause
#include "graph/motion_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "kinematics/joint_path.hpp"
#include "kinematics/tube_motion.hpp"
#include "model/compile.hpp"
#include "rounding/error_model.hpp"
#include "simd/compile/single.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

constexpr float kEverywhere = std::numeric_limits<float>::infinity();

/// m. Nothing is proven of coordinates that may be larger.
constexpr double kLargestCoordinate = 1e30;

}  // namespace

SingleBox unboundedBox() {
  return {{-kEverywhere, -kEverywhere, -kEverywhere, kEverywhere, kEverywhere, kEverywhere}};
}

SingleBox emptyBox() {
  return {{kEverywhere, kEverywhere, kEverywhere, -kEverywhere, -kEverywhere, -kEverywhere}};
}

SingleBox singleBox(const Vector3d& lower, const Vector3d& upper) {
  SingleBox box;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (!(lower[k] > -kLargestCoordinate) || !(upper[k] < kLargestCoordinate))
      return unboundedBox();
    box.sides[i] = singleBelow(lower[k]);
    box.sides[i + 3] = singleAbove(upper[k]);
  }
  return box;
}

void SingleBox::extend(const SingleBox& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    sides[k] = std::min(sides[k], other.sides[k]);
    sides[k + 3] = std::max(sides[k + 3], other.sides[k + 3]);
  }
}

MotionBoxes::MotionBoxes(const Checker& checker) {
  model_.robot = std::shared_ptr<const Robot>(std::shared_ptr<const Robot>(), &checker.robot());
  model_.world = std::make_shared<const World>();
  model_.group = checker.group();
  model_.options = checker.options();
  compileGeometry(nullptr, model_);
  for (std::size_t i = 0; i < model_.robotGeometry.size(); ++i) {
    const RobotGeometry& geometry = model_.robotGeometry[i];
    if (geometry.body == 0) continue;
    const Aabb box = boundingBox(geometry.shape);
    moving_.push_back(
        {.geometry = static_cast<int>(i),
         .boxCenter = box.center(),
         .halfExtents = (box.upper - box.center()).cwiseMax(box.center() - box.lower),
         .tube = model_.tube.empty() ? 0.0 : tubeReach(model_, {.geometry = static_cast<int>(i)})});
    transforms_ = std::max(transforms_, geometry.transforms);
  }
}

SingleBox MotionBoxes::partBox(const Moving& moving, double half, const PointMotionBound& bound,
                               const Scratch& scratch) const {
  const RobotGeometry& geometry = model_.robotGeometry[static_cast<std::size_t>(moving.geometry)];
  const BodyState& state = scratch.states[static_cast<std::size_t>(geometry.body)];
  const Eigen::Isometry3d world_from_shape = state.world_from_body * geometry.body_from_shape;
  const Vector3d middle = world_from_shape * moving.boxCenter;
  const Vector3d extents = world_from_shape.linear().cwiseAbs() * moving.halfExtents;
  const Vector3d ball = state.world_from_body * geometry.center;
  const Vector3d turn = state.angular.cwiseAbs();
  const Vector3d speed = (state.linear + state.angular.cross(middle)).cwiseAbs();
  const Vector3d ballSpeed = (state.linear + state.angular.cross(ball)).cwiseAbs();
  const CarriedRounding& carried = scratch.carried[static_cast<std::size_t>(geometry.body)];
  const double perMetre = tolerance::kRoundingPerJoint * (geometry.transforms + 2.0);
  const double span = geometry.levers.spanAtRest;
  const double travel = half * bound.speed * (1.0 + kVelocityRounding);
  // As GeometryPair::rounding and PairQuery::rounding, without the world's part.
  const double rounding = perMetre * (std::max(span, geometry.magnitude) + carried.slid) +
                          carried.angleError * (span + carried.slid) + carried.slideError +
                          velocityRounding(geometry.transforms) * travel + geometry.sourceError;
  const double curvature = 0.5 * half * half * bound.acceleration * (1.0 + kVelocityRounding);
  const double always = rounding + moving.tube;
  Vector3d lower, upper;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double moved = half * (speed[k] + turn[i] * extents[j] + turn[j] * extents[i]);
    const double ballMoved = half * (ballSpeed[k] + geometry.radius * std::hypot(turn[i], turn[j]));
    const double reach =
        (extents[k] + std::min(travel, moved + curvature)) * kArithmeticOutward + always;
    const double ballReach =
        (geometry.radius + std::min(travel, ballMoved + curvature)) * kArithmeticOutward + always;
    lower[k] = std::max(middle[k] - reach, ball[k] - ballReach);
    upper[k] = std::min(middle[k] + reach, ball[k] + ballReach);
    // NaN bounds nothing.
    if (!(reach < kLargestCoordinate) || !(ballReach < kLargestCoordinate)) return unboundedBox();
  }
  return singleBox(lower, upper);
}

void MotionBoxes::find(std::span<const double> from, std::span<const double> to,
                       std::span<SingleBox> boxes, Scratch& scratch) const {
  const KinematicModel& kinematics = model_.kinematics;
  scratch.motion.resize(kinematics.bodies.size());
  scratch.carried.resize(kinematics.bodies.size());
  scratch.states.resize(kinematics.bodies.size());
  scratch.bounds.resize(moving_.size());
  if (!StraightPath(kinematics, from, to).linearize(0.5, 0.5, scratch.motion)) {
    std::ranges::fill(boxes, unboundedBox());
    return;
  }
  if (!model_.tube.empty()) widenRanges(kinematics, model_.tube, scratch.motion);
  for (std::size_t i = 1; i < kinematics.bodies.size(); ++i)
    scratch.carried[i] = carriedRounding(
        scratch.carried[static_cast<std::size_t>(kinematics.bodies[i].parent)], scratch.motion[i]);
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    const RobotGeometry& geometry =
        model_.robotGeometry[static_cast<std::size_t>(moving_[i].geometry)];
    std::span<const double> arms = geometry.levers.arms;
    if (geometry.levers.vary) {
      scratch.arms.resize(geometry.levers.path.size());
      motionArms(kinematics, geometry.body, geometry.center, geometry.radius, scratch.motion,
                 scratch.arms);
      arms = scratch.arms;
    }
    scratch.bounds[i] = pointMotionBound(kinematics, geometry.levers.path, arms, 0, scratch.motion);
  }
  constexpr double kHalf = 0.5 / static_cast<double>(kParts);
  for (std::size_t part = 0; part < kParts; ++part) {
    const double middle = static_cast<double>(2 * part + 1) * kHalf;
    for (std::size_t body = 1; body < kinematics.bodies.size(); ++body)
      evaluateBody(kinematics, scratch.motion, middle, static_cast<int>(body), scratch.states);
    for (std::size_t i = 0; i < moving_.size(); ++i)
      boxes[pieces() * part + i] = partBox(moving_[i], kHalf, scratch.bounds[i], scratch);
  }
}

}  // namespace swept::detail
