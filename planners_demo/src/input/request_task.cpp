// SPDX-License-Identifier: BSD-3-Clause
#include "input/request_task.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "command_line/exit_code.hpp"
#include "input/groups.hpp"
#include "input/states.hpp"
#include "output/text_output.hpp"
#include "robot/joint_types.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept {
namespace {

/// rad or m. A joint that stays where it is may be asked for in fewer digits than it has.
constexpr double kPlay = 1e-3;

/// The group's values among a request's. Throws UsageError for one that is missing or wrong.
std::vector<double> requestState(const Robot& robot, const Group& group,
                                 const PlanningRequest::JointValues& values,
                                 const std::string& label, const Warn& warn) {
  std::string text;
  for (const int v : group.variables) {
    const std::string& name = robot.variables()[v].name;
    const auto found =
        std::ranges::find(values, name, &PlanningRequest::JointValues::value_type::first);
    if (found == values.end()) throw UsageError(label + ": it has no value for " + name);
    text += (text.empty() ? "" : ",") + exactNumber(found->second);
  }
  return readState(robot, group, text, label, warn);
}

/// With those of bases. Throws UsageError.
PlanningRequest::JointValues startOf(const Robot& robot, const PlanningRequest& request,
                                     const std::string& file) {
  try {
    return request.startOf(robot);
  } catch (const std::invalid_argument& error) {
    throw UsageError(file + ", start: " + error.what());
  }
}

/// The start's values of all joints, those outside the group too, over the scene's: they have
/// limits as well, and are taken to them as the group's are.
Eigen::VectorXd referenceOf(const Model& model, const PlanningRequest::JointValues& start,
                            const std::string& file, const Warn& warn) {
  const Robot& robot = *model.robot;
  Eigen::VectorXd reference = model.reference.value_or(robot.defaultState());
  for (const auto& [name, value] : start) {
    const std::optional<int> variable = robot.findVariable(name);
    if (!variable && !robot.findJoint(name))
      throw UsageError(file + ", start: robot '" + robot.name() + "' has no joint '" + name + "'");
    if (!variable) continue;  // it mimics another
    reference[*variable] = value;
    const Variable& limited = robot.variables()[*variable];
    const auto limit = limitNear(limited, value);
    if (!limit || isOrientation(robot, limited)) continue;
    warn("swept: warning: " + limitRemark({name, value, *limit, unitOf(robot, limited)}));
    reference[*variable] = *limit;
  }
  return reference;
}

/// The goal's value of a variable that the group moves, else the one that it has.
double valueInGoal(const Robot& robot, int variable, const Eigen::VectorXd& reference,
                   const PlanningRequest::JointValues& goal) {
  const std::string& name = robot.variables()[static_cast<std::size_t>(variable)].name;
  const auto found =
      std::ranges::find(goal, name, &PlanningRequest::JointValues::value_type::first);
  return found == goal.end() ? reference[variable] : found->second;
}

/// A path moves the group alone: another joint is only where the request has it if it is there
/// anyway, or follows to there.
void requireReachable(const Robot& robot, const Group& group, const Eigen::VectorXd& reference,
                      const PlanningRequest::JointValues& goal, const std::string& label) {
  for (const auto& [name, value] : goal) {
    const std::optional<int> variable = robot.findVariable(name);
    const std::optional<int> joint = robot.findJoint(name);
    const std::string who = label + ": joint '" + name + "'";
    if (!variable && !joint) throw UsageError(who + " is none of robot '" + robot.name() + "'");
    double reached = 0.0;
    bool turns = false;
    if (variable) {
      if (std::ranges::find(group.variables, *variable) != group.variables.end()) continue;
      reached = reference[*variable];
      turns = robot.variables()[static_cast<std::size_t>(*variable)].cyclic;
    } else if (const auto& mimic = robot.joints()[static_cast<std::size_t>(*joint)].mimic) {
      const Joint& master = robot.joints()[static_cast<std::size_t>(mimic->master)];
      reached = mimic->multiplier * valueInGoal(robot, master.firstVariable, reference, goal) +
                mimic->offset;
      turns = robot.joints()[static_cast<std::size_t>(*joint)].type == JointType::Continuous;
    }
    const double off =
        turns ? std::remainder(value - reached, 2.0 * std::numbers::pi) : value - reached;
    if (std::abs(off) <= kPlay) continue;
    throw UsageError(who + " is at " + shortNumber(reached) + ", where group '" + group.name +
                     "' has it, and not at " + shortNumber(value));
  }
}

/// Bounds of a base's position, which no planner here keeps.
void refuseWorkspace(const Robot& robot, const Group& group, const PlanningRequest& request,
                     const std::string& file) {
  if (!request.workspace) return;
  for (const int j : group.joints) {
    const Joint& joint = robot.joints()[static_cast<std::size_t>(j)];
    if (detail::slidesFreely(joint.type))
      throw UsageError(file + ": workspace_parameters bound where joint '" + joint.name +
                       "' may go, which is not supported");
  }
}

/// The model with what the request's robot carries: in place of a body of the scene where one has
/// its name. A body of --attach stays.
Model withAttachedOf(const PlanningRequest& request, const Arguments& args, Model model) {
  for (const AttachedBody& body : request.attached) {
    const auto endOfScene = model.attached.end() - std::ssize(args.attached);
    const auto same =
        std::ranges::find(model.attached.begin(), endOfScene, body.name, &AttachedBody::name);
    if (same != endOfScene)
      *same = body;
    else
      model.attached.insert(endOfScene, body);
  }
  model.weakerRules = request.rules.over(model.weakerRules);
  return model;
}

}  // namespace

Task requestTask(const Arguments& args, const Model& given, Warnings& warnings) {
  const PlanningRequest request = PlanningRequest::load(args.request, *given.robot, given.options);
  const Model model = withAttachedOf(request, args, given);
  const Robot& robot = *model.robot;
  const Group& group =
      asksForGroup(args) ? chooseGroup(robot, args) : chooseGroup(robot, request.group);
  if (request.goals.size() + request.poseGoals.size() > 1 && !request.poseGoals.empty())
    throw UsageError(args.request + ": a goal pose has to be its only goal");
  const PlanningRequest::JointValues start = startOf(robot, request, args.request);
  const auto stateOf = [&](const PlanningRequest::JointValues& values, const std::string& label) {
    return requestState(robot, group, values, args.request + ", " + label, std::ref(warnings));
  };
  refuseWorkspace(robot, group, request, args.request);
  const Eigen::VectorXd reference = referenceOf(model, start, args.request, std::ref(warnings));
  requireReachable(robot, group, reference, start, args.request + ", start");
  Task task;
  task.alternatives = true;
  task.checker = makeChecker(args, model, group, model.world, warnings, reference);
  task.states.push_back({.label = "start", .q = stateOf(start, "start")});
  for (std::size_t i = 0; i < request.goals.size(); ++i) {
    const std::string goal =
        request.goals.size() > 1 ? "goal " + std::to_string(i + 1) : std::string("goal");
    requireReachable(robot, group, reference, request.goals[i], args.request + ", " + goal);
    task.states.push_back({.label = goal, .q = stateOf(request.goals[i], goal)});
  }
  task.constraints = request.pathConstraints;
  if (!request.poseGoals.empty()) task.poseGoal = request.poseGoals.front();
  return task;
}

}  // namespace swept
