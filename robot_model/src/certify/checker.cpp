// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/checker.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "certify/motion_check.hpp"
#include "certify/signed_clearance.hpp"
#include "certify/state_check.hpp"
#include "certify/trajectory_check.hpp"
#include "certify/workspace_data.hpp"
#include "kinematics/full_state.hpp"
#include "model/pair_reasons.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/limits.hpp"
#include "text/numbers.hpp"

namespace swept {

namespace {

void requireMargin(const std::string& name, double value) {
  if (value >= 0.0 && std::isfinite(value)) return;
  throw std::invalid_argument("Checker: " + name + " " + detail::formatNumber(value) +
                              " m must be a finite number that is not negative");
}

void validate(const Robot& robot, const CheckerOptions& options) {
  requireMargin("margin", options.margin);
  if (options.selfMargin) requireMargin("selfMargin", *options.selfMargin);
  if (options.worldMargin) requireMargin("worldMargin", *options.worldMargin);
  if (!(options.tolerance > 0.0) || !std::isfinite(options.tolerance)) {
    throw std::invalid_argument("Checker: tolerance " + detail::formatNumber(options.tolerance) +
                                " m must be a finite number greater than zero");
  }
  if (options.maxIntervals < 1) {
    throw std::invalid_argument("Checker: maxIntervals " + std::to_string(options.maxIntervals) +
                                " must be at least 1");
  }
  if (options.reference)
    detail::requireFullState(robot, *options.reference, "Checker", "the reference");
}

const Group& findGroup(const Robot& robot, std::string_view name) {
  if (const Group* group = robot.findGroup(name)) return *group;
  for (const LeftOut& out : robot.leftOut())
    if (out.group == name && out.state.empty())
      throw std::invalid_argument("Checker: group '" + out.group + "' of robot '" + robot.name() +
                                  "' is left out: " + out.reason);
  std::string known;
  for (const Group& group : robot.groups()) known += (known.empty() ? "" : ", ") + group.name;
  throw std::invalid_argument("Checker: robot '" + robot.name() + "' has no group '" +
                              std::string(name) + "'; its groups are: " + known);
}

}  // namespace

Workspace::Workspace(const Checker& checker)
    : data_(inDefaultEnvironment(
          [&] { return std::make_unique<detail::WorkspaceData>(*checker.model_); })) {}
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;
Workspace::~Workspace() = default;

Checker::Checker(std::shared_ptr<const Robot> robot, std::string_view group,
                 std::shared_ptr<const World> world, const CheckerOptions& options) {
  if (detail::inForeignEnvironment()) {
    *this = inDefaultEnvironment(
        [&] { return Checker(std::move(robot), group, std::move(world), options); });
    return;
  }
  if (!robot || !world) throw std::invalid_argument("Checker: robot and world must not be null");
  validate(*robot, options);
  const Group& found = findGroup(*robot, group);
  model_ = detail::compileChecker(std::move(robot), found, std::move(world), options);
}

Checker::Checker(std::shared_ptr<const detail::CheckerModel> model) : model_(std::move(model)) {}

detail::WorkspaceData& Checker::dataOf(Workspace& workspace) const {
  if (workspace.data_->version != model_->version)
    workspace.data_ = std::make_unique<detail::WorkspaceData>(*model_);
  return *workspace.data_;
}

const Robot& Checker::robot() const {
  return *model_->robot;
}
const World& Checker::world() const {
  return *model_->world;
}
const Group& Checker::group() const {
  return model_->group;
}
const CheckerOptions& Checker::options() const {
  return model_->options;
}
int Checker::dimension() const {
  return model_->kinematics.dimension;
}

const std::vector<Checker::Pair>& Checker::checkedPairs() const {
  return *inDefaultEnvironment([this] { return &detail::pairLists(*model_).checked; });
}
const std::vector<Checker::Pair>& Checker::skippedPairs() const {
  return *inDefaultEnvironment([this] { return &detail::pairLists(*model_).skipped; });
}
std::vector<std::string> Checker::linksWithoutGeometry() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < robot().links().size(); ++i) {
    const Link& link = robot().links()[i];
    if (link.hasVisual && link.collision.empty() && model_->kinematics.bodyOfLink[i] != 0)
      names.push_back(link.name);
  }
  return names;
}
bool Checker::checksNothing() const {
  return std::ranges::none_of(model_->bodyPairs, [](const detail::BodyPair& pair) {
    return pair.reason == detail::PairReason::Checked ||
           pair.reason == detail::PairReason::OutOfReach;
  });
}
const std::vector<Checker::Pair>& Checker::staticContacts() const {
  return *inDefaultEnvironment([this] { return &detail::pairLists(*model_).standing; });
}

std::string Checker::explain(std::string_view bodyA, std::string_view bodyB) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, bodyA, bodyB] { return explain(bodyA, bodyB); });
  }
  return detail::explainPair(*model_, bodyA, bodyB);
}

void Checker::requireSize(std::span<const double> q) const {
  if (static_cast<int>(q.size()) == dimension()) return;
  throw std::invalid_argument("Checker: a configuration of group '" + group().name + "' has " +
                              std::to_string(dimension()) + " values, not " +
                              std::to_string(q.size()));
}

void Checker::requireSizes(std::span<const double> states, std::size_t count) const {
  const std::size_t expected = count * static_cast<std::size_t>(dimension());
  if (states.size() == expected) return;
  throw std::invalid_argument("Checker: " + std::to_string(count) + " states of group '" +
                              group().name + "' have " + std::to_string(expected) +
                              " values, not " + std::to_string(states.size()));
}

Verdict Checker::checkState(ConfigurationView q, Workspace& workspace) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, q] { return checkState(q, workspace); });
  }
  requireSize(q);
  return detail::checkState(*model_, q, dataOf(workspace));
}

void Checker::checkStates(PackedConfigurations states, std::span<Verdict> verdicts,
                          Workspace& workspace) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, states, verdicts] { return checkStates(states, verdicts, workspace); });
  }
  requireSizes(states, verdicts.size());
  detail::checkStates(*model_, states, verdicts, dataOf(workspace));
}

StateReport Checker::reportState(ConfigurationView q, Workspace& workspace) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, q] { return reportState(q, workspace); });
  }
  requireSize(q);
  return detail::reportState(*model_, q, dataOf(workspace));
}

double Checker::clearance(ConfigurationView q, Workspace& workspace) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, q] { return clearance(q, workspace); });
  }
  requireSize(q);
  return detail::stateClearance(*model_, q, dataOf(workspace));
}

SignedClearance Checker::signedClearance(ConfigurationView q, Workspace& workspace,
                                         ConfigurationSpan gradient) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, q, gradient] { return signedClearance(q, workspace, gradient); });
  }
  requireSize(q);
  if (!gradient.empty()) requireSize(gradient);
  return detail::signedClearance(*model_, q, gradient, dataOf(workspace));
}

MotionCertificate Checker::certifyMotion(ConfigurationView from, ConfigurationView to,
                                         Workspace& workspace, MotionQuery query) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, from, to, query] { return certifyMotion(from, to, workspace, query); });
  }
  requireSize(from);
  requireSize(to);
  return detail::certifyMotion(*model_, from, to, query, dataOf(workspace));
}

TrajectoryCertificate Checker::certifyTrajectory(const PiecewisePolynomial& curve,
                                                 Workspace& workspace,
                                                 const TrajectoryQuery& query) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return certifyTrajectory(curve, workspace, query); });
  }
  const std::size_t values = group().variables.size();
  const auto require = [&](std::size_t size, const char* what) {
    if (size == values) return;
    throw std::invalid_argument("Checker: " + std::string(what) + " of group '" + group().name +
                                "' has " + std::to_string(values) + " values, not " +
                                std::to_string(size));
  };
  require(static_cast<std::size_t>(curve.dimension()), "a curve");
  if (query.limits) {
    require(query.limits->velocity.size(), "RateLimits::velocity");
    require(query.limits->acceleration.size(), "RateLimits::acceleration");
    require(query.limits->jerk.size(), "RateLimits::jerk");
  }
  if (!std::isfinite(query.clock))
    throw std::invalid_argument("Checker: clock " + detail::formatNumber(query.clock) +
                                " s must be a finite number");
  const std::string floating = detail::turnsFreely(*model_, curve);
  if (!floating.empty())
    throw std::invalid_argument("Checker: the orientation of floating joint '" + floating +
                                "' changes along a piece of a higher degree than 1: its components "
                                "are no polynomials; allowed are pieces of degree 1 (slerp)");
  return detail::certifyTrajectory(*model_, curve, query, dataOf(workspace));
}

MotionClearance Checker::motionClearance(ConfigurationView from, ConfigurationView to,
                                         double accuracy, Workspace& workspace,
                                         ClearanceQuery query) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, from, to, accuracy, query] {
      return motionClearance(from, to, accuracy, workspace, query);
    });
  }
  requireSize(from);
  requireSize(to);
  if (!(accuracy > 0.0)) {
    throw std::invalid_argument("Checker: accuracy " + detail::formatNumber(accuracy) +
                                " m must be greater than zero");
  }
  const detail::StraightPath path(model_->kinematics, from, to);
  return detail::motionClearance(*model_, path, accuracy, query, dataOf(workspace));
}

bool Checker::withinLimits(ConfigurationView q) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, q] { return withinLimits(q); });
  }
  requireSize(q);
  const auto& kinematics = model_->kinematics;
  for (int i = 0; i < kinematics.dimension; ++i) {
    const bool inside = isWithin(q[i], kinematics.lower[i], kinematics.upper[i]);
    if (!inside || !std::isfinite(q[i])) return false;
  }
  return true;
}

Eigen::VectorXd Checker::interpolate(ConfigurationView from, ConfigurationView to, double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, from, to, t] { return interpolate(from, to, t); });
  }
  requireSize(from);
  requireSize(to);
  Eigen::VectorXd q(dimension());
  detail::interpolateMotion(model_->kinematics, from, to, t,
                            {q.data(), static_cast<std::size_t>(q.size())});
  return q;
}

void Checker::interpolate(ConfigurationView from, ConfigurationView to, double t,
                          ConfigurationSpan q) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, from, to, t, q] { return interpolate(from, to, t, q); });
  }
  requireSize(from);
  requireSize(to);
  requireSize(q);
  detail::interpolateMotion(model_->kinematics, from, to, t, q);
}

}  // namespace swept
