// SPDX-License-Identifier: BSD-3-Clause
#include "swept/ompl_bridge/pose_goal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "number_text.hpp"
#include "preconditions.hpp"
#include "space_bounds.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {
namespace ob = ompl::base;
namespace {

// Solutions this much inside the tolerances are still inside after a conversion's rounding.
constexpr double kInside = 0.5;

InverseKinematics kinematicsOf(const std::shared_ptr<const Checker>& checker, std::string_view link,
                               const PoseGoalOptions& options, const detail::SpaceBounds& bounds) {
  const std::shared_ptr<const Robot> robot(checker, &checker->robot());
  return InverseKinematics(robot, checker->group().name, link, checker->options().reference,
                           options.link_from_tool)
      .within(bounds.lower, bounds.upper);
}

/// The constraints of the checker, and that the tool is at the pose.
ConstraintProjection projectionOf(const Checker& checker, const std::string& link,
                                  const Eigen::Isometry3d& model_from_tool,
                                  const PoseGoalOptions& options,
                                  const detail::SpaceBounds& bounds) {
  TaskConstraint all = checker.options().constraints;
  const ConstraintFrame tool{.body = link, .body_from_frame = options.link_from_tool};
  if (std::isfinite(options.positionTolerance)) {
    ConstraintRegion ball{.type = ConstraintRegion::Type::Sphere,
                          .size = {options.positionTolerance, 0.0, 0.0}};
    ball.reference_from_region.translation() = model_from_tool.translation();
    all.positions.push_back({.frame = tool, .regions = {ball}});
  }
  if (std::isfinite(options.orientationTolerance)) {
    // Three angles: their rotation is no larger than the root of three times each.
    const double each = options.orientationTolerance / std::sqrt(3.0);
    all.orientations.push_back(
        {.frame = tool,
         .orientation = Eigen::Quaterniond(model_from_tool.linear()),
         .tolerance = {each, each, each},
         .parameterization = OrientationConstraint::Parameterization::RotationVector});
  }
  return ConstraintProjection(checker.withConstraints(std::move(all)))
      .within(bounds.lower, bounds.upper);
}

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("PoseGoal: " + what);
}

void requirePositive(double tolerance, const std::string& of, const std::string& unit) {
  if (tolerance > 0.0) return;
  refuse("the " + of + " tolerance is " + detail::numberText(tolerance) + " " + unit +
         "; it must be above 0");
}

void requireNotNegative(int number, const std::string& of) {
  if (number >= 0) return;
  refuse("the number of " + of + " is " + std::to_string(number) + "; it must be at least 0");
}

void requireSensible(const PoseGoalOptions& options) {
  requirePositive(options.positionTolerance, "position", "m");
  requirePositive(options.orientationTolerance, "orientation", "rad");
  requireNotNegative(options.maxSeeds, "seeds");
  requireNotNegative(options.maxSamples, "samples");
}

}  // namespace

PoseGoal::PoseGoal(const ob::SpaceInformationPtr& si, const std::shared_ptr<const Checker>& checker,
                   std::string_view link, const Eigen::Isometry3d& model_from_tool,
                   const PoseGoalOptions& options)
    : GoalLazySamples(
          si, [this](const GoalLazySamples*, ob::State* state) { return sample(state); }, false,
          kSampleDistance),
      bounds_(detail::boundsOf(*si->getStateSpace(),
                               *detail::requireChecker(checker, *si->getStateSpace()))),
      kinematics_(kinematicsOf(checker, link, options, bounds_)),
      conversion_(kinematics_.robot(), kinematics_.group()),
      model_from_tool_(model_from_tool),
      options_(options),
      workspace_(kinematics_),
      random_(options.seed),
      q_(bounds_.lower.size()) {
  requireSensible(options);
  requireTarget();
  if (!checker->options().constraints.empty()) {
    together_ = projectionOf(*checker, std::string(link), model_from_tool, options, bounds_);
    projecting_.emplace(*together_);
  }
  setThreshold(1.0);
  // Not in the base's constructor: the thread uses the members of this class. It begins in the
  // environment of the thread that starts it.
  inDefaultEnvironment([this] { startSampling(); });
}

PoseGoal::~PoseGoal() {
  stopSampling();
}

InverseKinematicsOptions PoseGoal::search() const {
  return {kInside * options_.positionTolerance, kInside * options_.orientationTolerance};
}

// A search of no steps refuses here what sample() must not throw for, since that would end the
// program.
void PoseGoal::requireTarget() {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return requireTarget(); });
  }
  InverseKinematicsOptions none = search();
  none.maxIterations = 0;
  drawSeed();
  kinematics_.solve(model_from_tool_, q_, none, workspace_);
}

double PoseGoal::distanceGoal(const ob::State* state) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, state] { return PoseGoal::distanceGoal(state); });
  }
  std::vector<double> q(q_.size());
  conversion_.toConfiguration(state, q);
  const std::optional<Eigen::Isometry3d> pose = kinematics_.findPose(q);
  if (!pose) return std::numeric_limits<double>::infinity();
  const PoseError error = poseError(*pose, model_from_tool_);
  return std::max(error.position / options_.positionTolerance,
                  error.angle / options_.orientationTolerance);
}

void PoseGoal::drawSeed() {
  for (std::size_t i = 0; i < q_.size(); ++i) {
    q_[i] = random_.uniformReal(bounds_.lower[i], bounds_.upper[i]);
  }
  for (const int first : bounds_.quaternions) random_.quaternion(&q_[first]);
}

bool PoseGoal::findState() {
  if (!kinematics_.solve(model_from_tool_, q_, search(), workspace_)) return false;
  return !together_ || together_->project(q_, {}, *projecting_);
}

// The caller, OMPL, keeps the state if it is valid and differs from those before it.
bool PoseGoal::sample(ob::State* state) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, state] { return sample(state); });
  }
  while (isSampling() && seeds_ < options_.maxSeeds &&
         getStateCount() < static_cast<std::size_t>(options_.maxSamples)) {
    ++seeds_;
    drawSeed();
    if (!findState()) continue;
    conversion_.toState(q_, state);
    return true;
  }
  return false;
}

}  // namespace swept
