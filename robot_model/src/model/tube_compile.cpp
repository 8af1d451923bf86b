// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "model/compile.hpp"
#include "model/pair_model.hpp"
#include "robot/joint_types.hpp"
#include "rounding/error_model.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

void requireTolerance(const JointTolerance& tolerance, const std::string& of) {
  const auto require = [&of](double value, const char* what, const char* unit) {
    if (value >= 0.0 && std::isfinite(value)) return;
    throw std::invalid_argument("Checker: tracking tolerance of " + of + " has " + what + " " +
                                formatNumber(value) + unit +
                                ", which must be a finite number that is not negative");
  };
  require(tolerance.rotation, "rotation", " rad");
  require(tolerance.translation, "translation", " m");
}

void requireMoved(const PairModel& model, const std::string& name) {
  const std::optional<int> joint = model.robot->findJoint(name);
  const std::string start = "Checker: tracking tolerance of joint '" + name + "', which ";
  if (!joint) throw std::invalid_argument(start + "the robot does not have");
  if (std::ranges::find(model.group.joints, *joint) != model.group.joints.end()) return;
  const Joint& found = model.robot->joints()[static_cast<std::size_t>(*joint)];
  throw std::invalid_argument(
      start + (found.mimic
                   ? "follows joint '" +
                         model.robot->joints()[static_cast<std::size_t>(found.mimic->master)].name +
                         "': its tolerance follows, too"
                   : "group '" + model.group.name + "' does not move"));
}

/// What its type leaves of a joint's tolerance, as the values of a body.
JointTolerance toleranceOf(const PairModel& model, const MovingBody& body) {
  if (body.joint < 0) return {};
  const Joint& joint = model.robot->joints()[static_cast<std::size_t>(body.joint)];
  const Joint& master =
      joint.mimic ? model.robot->joints()[static_cast<std::size_t>(joint.mimic->master)] : joint;
  const TrackingTolerance& tracking = model.options.tracking;
  const auto own = tracking.joints.find(master.name);
  JointTolerance tolerance =
      own == tracking.joints.end() ? static_cast<const JointTolerance&>(tracking) : own->second;
  const double factor = joint.mimic ? std::abs(joint.mimic->multiplier) : 1.0;
  // A joint that slides may follow one that turns.
  const double value = factor * (turns(master.type) ? tolerance.rotation : tolerance.translation);
  switch (joint.type) {
    case JointType::Revolute:
    case JointType::Continuous:
      return {.rotation = value, .translation = 0.0};
    case JointType::Prismatic:
      return {.rotation = 0.0, .translation = value};
    case JointType::Planar:
    case JointType::Floating:
      return tolerance;
    case JointType::Fixed:
      break;
  }
  return {};
}

bool isZero(const JointTolerance& tolerance) {
  return tolerance.rotation == 0.0 && tolerance.translation == 0.0;
}

}  // namespace

void compileTube(PairModel& model) {
  const TrackingTolerance& tracking = model.options.tracking;
  requireTolerance(tracking, "all joints");
  for (const auto& [name, tolerance] : tracking.joints) {
    requireTolerance(tolerance, "joint '" + name + "'");
    requireMoved(model, name);
  }
  model.tube.clear();
  for (const MovingBody& body : model.kinematics.bodies)
    model.tube.push_back(toleranceOf(model, body));
  if (std::ranges::all_of(model.tube, isZero)) model.tube.clear();
}

/// No joint moves a point by more than its tolerance times the point's lever arm.
double tubeReach(const PairModel& model, const MotionBoundSlot& slot) {
  const LeverArms& levers = model.robotGeometry[static_cast<std::size_t>(slot.geometry)].levers;
  double reach = 0.0;
  double turned = 0.0;  // rad, by joints so far
  for (std::size_t i = slot.firstJoint; i < levers.path.size(); ++i) {
    const auto body = static_cast<std::size_t>(levers.path[i]);
    // Its translation has no limits, and lengthens the arms of all joints before it.
    if (slidesFreely(model.kinematics.bodies[body].type) && turned > 0.0)
      return std::numeric_limits<double>::infinity();
    const JointTolerance& tolerance = model.tube[body];
    if (tolerance.rotation > 0.0) reach += tolerance.rotation * levers.arms[i];
    reach += tolerance.translation;
    turned += tolerance.rotation;
  }
  return reach * kArithmeticOutward;
}

void boundTube(PairModel& model) {
  if (model.tube.empty()) return;
  model.worldTubes.assign(model.robotGeometry.size(), 0.0);
  for (std::size_t i = 0; i < model.worldTubes.size(); ++i) {
    const bool isPaired = model.firstWorldPair[i] < model.firstWorldPair[i + 1];
    if (!isPaired) continue;
    const auto slot = static_cast<std::size_t>(model.likeWorldPairs[i].motionBoundA);
    model.worldTubes[i] = tubeReach(model, model.motionBounds[slot]);
  }
  for (GeometryPair& pair : model.pairs) {
    pair.tube = tubeReach(model, model.motionBounds[static_cast<std::size_t>(pair.motionBoundA)]);
    if (pair.motionBoundB >= 0)
      pair.tube +=
          tubeReach(model, model.motionBounds[static_cast<std::size_t>(pair.motionBoundB)]);
  }
}

}  // namespace swept::detail
