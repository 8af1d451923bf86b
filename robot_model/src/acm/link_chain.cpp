// SPDX-License-Identifier: BSD-3-Clause
#include "acm/link_chain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "robot/joint_types.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

/// rad or m. Beyond it, the rounding of a joint's value exceeds that of the joint's transform.
constexpr double kFarthest = 1000.0;

}  // namespace

KinematicModel wholeKinematics(const Robot& robot) {
  Group all;
  for (std::size_t j = 0; j < robot.joints().size(); ++j)
    if (robot.joints()[j].firstVariable >= 0) all.joints.push_back(static_cast<int>(j));
  all.variables.resize(robot.variables().size());
  std::iota(all.variables.begin(), all.variables.end(), 0);
  return compileKinematics(robot, all, robot.defaultState());
}

LinkChain::LinkChain(const Robot& robot, const KinematicModel& model, int bodyA, int bodyB,
                     double beyond)
    : model_(model), bodyA_(bodyA), bodyB_(bodyB) {
  int a = bodyA, b = bodyB;
  // Parents have smaller indices than their children.
  while (a != b) {
    int& later = a > b ? a : b;
    later = model.bodies[later].parent;
  }
  base_ = a;
  addPath(bodyA, false);
  addPath(bodyB, true);
  for (ChainJoint& joint : joints_) {
    order_.push_back(joint.body);
    addVariable(robot, joint);
  }
  std::ranges::sort(order_);
  limits_ = box_;
  if (bounded_) boundTurns();
  for (const ChainJoint& joint : joints_) {
    const std::size_t k = joint.variable;
    const double largest = std::max(std::abs(box_.lower[k]), std::abs(box_.upper[k]));
    bounded_ = bounded_ && joint.scale * largest <= kFarthest;
  }
  for (std::size_t k = 0; k < variables_.size(); ++k) {
    const bool near = std::abs(box_.lower[k]) <= kFarthest && std::abs(box_.upper[k]) <= kFarthest;
    // For a box without values anything could be proven.
    bounded_ = bounded_ && near && box_.lower[k] <= box_.upper[k];
    const bool turnsOnly = std::ranges::none_of(
        joints_, [k](const ChainJoint& joint) { return joint.variable == k && joint.slides; });
    const double more = tolerance::kLimit + (turnsOnly ? beyond : 0.0);
    box_.lower[k] -= more;
    box_.upper[k] += more;
  }
}

void LinkChain::addPath(int from, bool reversed) {
  const auto first = static_cast<std::ptrdiff_t>(joints_.size());
  for (int i = from; i != base_; i = model_.bodies[i].parent) {
    const MovingBody& body = model_.bodies[i];
    ChainJoint joint;
    joint.body = i;
    joint.slides = slidesWithinLimits(body.type);
    joint.scale = std::abs(body.multiplier);
    reach_ += body.parent_from_joint.translation().norm();
    if (joint.slides) reach_ += std::max(std::abs(body.lower), std::abs(body.upper));
    joints_.push_back(joint);
  }
  if (reversed) std::reverse(joints_.begin() + first, joints_.end());
}

void LinkChain::addVariable(const Robot& robot, ChainJoint& joint) {
  const MovingBody& body = model_.bodies[joint.body];
  const int count = valueCount(body.type);
  bounded_ = bounded_ && count <= 1 && std::abs(body.offset) <= kFarthest;
  const auto known = std::ranges::find(variables_, body.variable);
  joint.variable = static_cast<std::size_t>(known - variables_.begin());
  if (known != variables_.end()) return;
  for (int i = 0; i < count; ++i) {
    variables_.push_back(body.variable + i);
    box_.lower.push_back(robot.variables()[body.variable + i].lower);
    box_.upper.push_back(robot.variables()[body.variable + i].upper);
  }
}

/// After a turn of a variable everything is as before if each joint that follows it turns, by whole
/// turns. The value of a joint without limits is the same angle after any turns: then this must
/// hold.
void LinkChain::boundTurns() {
  constexpr double turn = 2.0 * std::numbers::pi;
  for (std::size_t k = 0; k < variables_.size(); ++k) {
    bool periodic = true;
    for (const ChainJoint& joint : joints_) {
      if (joint.variable != k) continue;
      periodic = periodic && !joint.slides && joint.scale == std::round(joint.scale);
    }
    if (model_.cyclic[variables_[k]] != 0 && !periodic) bounded_ = false;
    if (!periodic) continue;
    // For turns so far out that angles round, any other turn is as good.
    const bool far = !(std::abs(box_.lower[k]) <= kFarthest);
    if (far && box_.upper[k] - box_.lower[k] >= turn) {
      box_.lower[k] = -std::numbers::pi;
      box_.upper[k] = std::numbers::pi;
    } else {
      box_.upper[k] = std::min(box_.upper[k], box_.lower[k] + turn);
    }
  }
}

void LinkChain::startFrom(const Eigen::VectorXd& configuration, Place& place) const {
  place.q.assign(configuration.begin(), configuration.end());
  place.motion.resize(model_.bodies.size());
  place.states.resize(model_.bodies.size());
  place.axes.resize(joints_.size());
}

bool LinkChain::moveTo(std::span<const double> values, Place& place) const {
  for (std::size_t k = 0; k < variables_.size(); ++k) place.q[variables_[k]] = values[k];
  place.states[base_] = BodyState{};
  for (const int body : order_) {
    if (!compileJoint(model_, model_.bodies[body], place.q, place.q, place.motion[body]))
      return false;
    evaluateBody(model_, place.motion, 0.0, body, place.states);
  }
  place.base_from_a = place.states[bodyA_].world_from_body;
  place.base_from_b = place.states[bodyB_].world_from_body;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    // A joint does not move its own axis, and its child's origin stays on the axis.
    const int body = joints_[j].body;
    const Eigen::Isometry3d& pose = place.states[body].world_from_body;
    place.axes[j] = {pose.translation(), pose.linear() * model_.bodies[body].axis};
  }
  return true;
}

}  // namespace swept::detail
