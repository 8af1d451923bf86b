// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/pages/task_page.hpp"
#include "swept/proofs/task_proof.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"
#include "swept/robot_model/proven_trajectory.hpp"
#include "swept/robot_model/tool_line.hpp"

/// The motions of a robot that grasps and releases things: where all joints and bodies are by now,
/// and each motion so far with its proof. A motion without a proof throws std::runtime_error.
class RecordedTask {
 public:
  RecordedTask(std::shared_ptr<const swept::Robot> robot, swept::World world)
      : robot_(std::move(robot)),
        world_(std::move(world)),
        state_(robot_->defaultState()),
        page_({.title = "pick and place", .headline = {}, .facts = {}}) {}

  const std::shared_ptr<const swept::Robot>& robot() const { return robot_; }
  const swept::World& world() const { return world_; }
  const Eigen::VectorXd& state() const { return state_; }  ///< of all variables
  /// Before the first motion.
  void stand(const std::string& group, const std::vector<double>& values) { set(group, values); }
  std::vector<double> values(const std::string& group) const {
    std::vector<double> q;
    for (const int variable : robot_->findGroup(group)->variables) q.push_back(state_[variable]);
    return q;
  }
  /// Of a frame that a group moves, in the model frame.
  Eigen::Isometry3d pose(const std::string& group, const swept::ConstraintFrame& frame) const {
    return swept::InverseKinematics(robot_, group, frame.body, state_, frame.body_from_frame)
        .pose(values(group));
  }

  /// m. What planned motions keep from the world. They are proven without it: planes between bodies
  /// need room.
  static constexpr double kRoom = 0.005;

  /// What checks a group's motions from here on. `margin`: m, from the world.
  std::shared_ptr<const swept::Checker> checker(const std::string& group,
                                                const swept::CollisionRules& rules = {},
                                                const swept::TaskConstraint& keep = {},
                                                double margin = 0.0) const {
    swept::CheckerOptions options;
    options.rules = rules;
    options.reference = state_;
    options.attached = attached_;
    options.constraints = keep;
    options.worldMargin = margin;
    return std::make_shared<const swept::Checker>(
        robot_, group, std::make_shared<const swept::World>(world_), options);
  }

  /// Plans to a configuration of a group.
  void plan(const std::string& name, const std::string& group, const std::vector<double>& goal,
            const swept::TaskConstraint& keep = {}) {
    const auto own = checker(group, {}, keep, kRoom);
    const auto setup = swept::makeSimpleSetup(own);
    swept::setStartAndGoal(*setup, *own, values(group), goal);
    setup->setPlanner(std::make_shared<swept::CertifiedConnect>(setup->getSpaceInformation()));
    const auto planned = swept::planTrajectory(*setup, limitsOf(*own));
    if (!planned.isProven()) throw std::runtime_error("no way for '" + name + "'");
    record(name, checker(group, {}, keep), planned.trajectory->timed.trajectory);
  }
  /// Moves a tool along a straight line, to a pose in the model frame.
  void line(const std::string& name, const std::string& group, const swept::ConstraintFrame& tool,
            const Eigen::Isometry3d& goal, const swept::CollisionRules& rules = {}) {
    const auto own = checker(group, rules);
    swept::Workspace workspace(*own);
    const swept::ToolLine line =
        swept::ToolLinePlanner(own, tool).plan(values(group), goal, workspace);
    if (!line.complete())
      throw std::runtime_error("'" + name + "': " + swept::describe(*line.stop, {}));
    follow(name, own, line.wayPoints);
  }
  /// Moves straight from configuration to configuration.
  void follow(const std::string& name, const std::shared_ptr<const swept::Checker>& own,
              const std::vector<std::vector<double>>& wayPoints) {
    const auto proven =
        swept::provenTrajectory(*own, wayPoints, limitsOf(*own), {.blendDeviation = 1e-3});
    record(name, own, proven.timed.trajectory);
  }

  /// A link carries a body of the world from now on.
  void attach(const std::string& body, const std::string& group, const std::string& link,
              std::vector<std::string> touchLinks) {
    swept::AttachedBody held{.name = body, .link = link, .touchLinks = std::move(touchLinks)};
    for (const swept::WorldBody::Part& part : world_.find(body)->parts)
      held.parts.push_back(
          {part.shape, pose(group, {.body = link}).inverse() * part.world_from_shape});
    world_.remove(body);
    attached_.push_back(std::move(held));
    changed(swept::TaskChange::Kind::Attached, body, body + " attached to " + link);
  }
  /// It stays where it is.
  void place(const std::string& body, const std::string& group) {
    swept::WorldBody placed = checker(group)->detachedBody(body, values(group));
    std::erase_if(attached_, [&](const auto& held) { return held.name == body; });
    world_.add(std::move(placed));
    changed(swept::TaskChange::Kind::Placed, body, body + " placed");
  }
  /// A body of the world as it was sensed anew.
  void sense(swept::WorldBody body) {
    changed(swept::TaskChange::Kind::Sensed, body.name, body.name + " sensed");
    if (world_.find(body.name) != nullptr) world_.remove(body.name);
    world_.add(std::move(body));
  }

  /// Writes FOLDER/NAME.json, with the proof of all, and FOLDER/NAME.html.
  void write(const std::filesystem::path& folder, const std::string& name) const {
    const auto written = swept::writeTask(folder / (name + ".json"), phases_);
    if (!written.isWritten()) throw std::runtime_error("no proof: " + written.missing);
    page_.write(folder / (name + ".html"));
  }
  std::size_t phases() const { return phases_.size(); }
  double seconds() const { return clock_; }

 private:
  void set(const std::string& group, const std::vector<double>& values) {
    const std::vector<int>& variables = robot_->findGroup(group)->variables;
    for (std::size_t i = 0; i < values.size(); ++i) state_[variables[i]] = values[i];
  }
  swept::RateLimits limitsOf(const swept::Checker& checker) const {
    swept::RateLimits limits = swept::RateLimits::of(*robot_, checker.group());
    for (double& limit : limits.acceleration) limit = 3.0;  // rad/s^2 or m/s^2
    return limits;
  }
  void changed(swept::TaskChange::Kind kind, const std::string& body, const std::string& words) {
    if (phases_.empty()) return;
    changes_.push_back({.kind = kind, .body = body});
    words_.push_back(words);
  }
  void record(const std::string& name, const std::shared_ptr<const swept::Checker>& own,
              const swept::JointTrajectory& trajectory) {
    swept::TaskPhase phase{.name = name,
                           .checker = own,
                           .trajectory = swept::delayed(trajectory, clock_),
                           .certificate = {},
                           .changes = std::exchange(changes_, {})};
    const swept::PiecewisePolynomial curve = swept::controllerCurve(phase.trajectory);
    swept::TrajectoryQuery query{.limits = limitsOf(*own), .clearances = true};
    swept::Workspace workspace(*own);
    phase.certificate = own->certifyTrajectory(curve, workspace, query);
    std::cout << name << ": " << toString(phase.certificate.verdict) << ", until " << curve.end()
              << " s" << std::endl;
    if (phase.certificate.verdict != swept::Verdict::Free)
      throw std::runtime_error("'" + name + "' is not proven");
    page_.addPhase(name, own, curve, query, std::exchange(words_, {}));
    clock_ = curve.end();
    set(own->group().name, phase.trajectory.points.back().positions);
    phases_.push_back(std::move(phase));
  }

  std::shared_ptr<const swept::Robot> robot_;
  swept::World world_;
  std::vector<swept::AttachedBody> attached_;
  Eigen::VectorXd state_;
  double clock_ = 0.0;                      ///< s
  std::vector<swept::TaskChange> changes_;  ///< since the last motion
  std::vector<std::string> words_;          ///< the same
  std::vector<swept::TaskPhase> phases_;
  swept::TaskPage page_;
};
