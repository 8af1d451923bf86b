// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/tool_line.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "kinematics/rigid_transform.hpp"
#include "line/line_model.hpp"
#include "line/line_search.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/did_you_mean.hpp"
#include "swept/robot_model/limits.hpp"
#include "text/numbers.hpp"

namespace swept {

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("ToolLinePlanner: " + what);
}

/// The link that carries the tool's frame.
std::string linkOfTool(const Checker& checker, const std::string& body) {
  if (body.empty()) refuse("the tool is fixed in the model frame");
  if (checker.robot().findLink(body)) return body;
  const std::vector<AttachedBody>& attached = checker.options().attached;
  const auto carried = std::ranges::find(attached, body, &AttachedBody::name);
  if (carried != attached.end()) return carried->link;
  std::vector<std::string> known;
  for (const Link& link : checker.robot().links()) known.push_back(link.name);
  for (const AttachedBody& other : attached) known.push_back(other.name);
  refuse("'" + body + "' is no link and no attached body" + didYouMean(body, known));
}

void requireSensible(const ToolLineOptions& options) {
  const auto require = [](double value, const std::string& what, const std::string& unit) {
    if (value > 0.0) return;
    refuse("the " + what + " is " + detail::formatNumber(value) + " " + unit +
           "; it must be above 0");
  };
  require(options.position, "allowed deviation of the position", "m");
  require(options.angle, "allowed deviation of the orientation", "rad");
  require(options.leastStep, "least step", "m");
  if (options.maxWayPoints < 2)
    refuse("the largest number of way points is " + std::to_string(options.maxWayPoints) +
           "; it must be at least 2");
}

/// The first variable that is outside its limits.
std::optional<std::string> outsideLimits(const Checker& checker, ConfigurationView q) {
  const Robot& robot = checker.robot();
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Variable& variable =
        robot.variables()[static_cast<std::size_t>(checker.group().variables[i])];
    if (!variable.cyclic && !isOrientation(robot, variable) &&
        !isWithin(q[i], variable.lower, variable.upper))
      return variable.name;
  }
  return std::nullopt;
}

}  // namespace

ToolLinePlanner::ToolLinePlanner(std::shared_ptr<const Checker> checker,
                                 const ConstraintFrame& tool) {
  if (detail::inForeignEnvironment()) {
    *this = inDefaultEnvironment([&] { return ToolLinePlanner(std::move(checker), tool); });
    return;
  }
  if (!checker) refuse("no checker given");
  if (!checker->world().obstacles().empty())
    refuse("the world has moving obstacles, and a line has no times");
  const std::string link = linkOfTool(*checker, tool.body);
  if (!detail::isRigid(tool.body_from_frame)) refuse("the tool is not a rigid transform");
  const Eigen::Isometry3d link_from_tool = detail::orthonormalized(tool.body_from_frame);
  const std::shared_ptr<const Robot> robot(checker, &checker->robot());
  const std::optional<Eigen::VectorXd>& held = checker->options().reference;
  InverseKinematics solver(robot, checker->group().name, link, held, link_from_tool);
  detail::KinematicModel kinematics =
      detail::compileKinematics(*robot, checker->group(), held ? *held : robot->defaultState());
  const detail::CarriedTool carried = detail::carriedTool(
      kinematics, static_cast<std::size_t>(*robot->findLink(link)), link_from_tool);
  model_ = std::make_shared<const detail::LineModel>(
      detail::LineModel{std::move(checker), std::move(kinematics), carried, std::move(solver)});
}

const Checker& ToolLinePlanner::checker() const {
  return *model_->checker;
}

Eigen::Isometry3d ToolLinePlanner::pose(ConfigurationView q) const {
  return model_->solver.pose(q);
}

ToolLine ToolLinePlanner::plan(ConfigurationView start, const Eigen::Isometry3d& goal,
                               Workspace& workspace, const ToolLineOptions& options) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, start] { return plan(start, goal, workspace, options); });
  }
  requireSensible(options);
  if (!detail::isRigid(goal)) refuse("the goal is not a rigid transform");
  ToolLine path;
  path.model_from_start = pose(start);
  path.model_from_goal = goal;
  const detail::StraightMotion line(path.model_from_start, detail::orthonormalized(goal));
  path.length = line.way.norm();
  path.turn = line.turn.norm();
  path.wayPoints.emplace_back(start.begin(), start.end());
  path.shares.push_back(0.0);
  if (const auto outside = outsideLimits(checker(), start)) {
    path.stop = ToolLineStop{.reason = ToolLineStop::Reason::Limit, .variable = *outside};
    return path;
  }
  detail::LineSearch(*model_, line, options, workspace, path).run();
  return path;
}

}  // namespace swept
