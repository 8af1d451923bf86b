// SPDX-License-Identifier: BSD-3-Clause
#include "input/task.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <utility>

#include "command_line/commands.hpp"
#include "input/attach.hpp"
#include "input/clouds.hpp"
#include "input/problem_choice.hpp"
#include "input/rules.hpp"
#include "input/states.hpp"
#include "input/unchecked.hpp"
#include "input/xacro.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept {
namespace {

constexpr double kLeastAccuracy = 1e-5;  // m

std::vector<PackageFolder> packageFolders(const Arguments& args) {
  std::vector<PackageFolder> folders;
  for (const std::string& text : args.packages) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw UsageError("--package '" + text + "': expected NAME=DIR");
    PackageFolder folder{.name = text.substr(0, equals), .folder = text.substr(equals + 1)};
    if (!std::filesystem::is_directory(folder.folder))
      throw UsageError("--package " + folder.name + ": no folder '" + folder.folder.string() + "'");
    folders.push_back(std::move(folder));
  }
  return folders;
}

std::string standingContactText(const Checker& checker) {
  std::vector<std::string> pairs;
  for (const Checker::Pair& pair : checker.standingContacts())
    pairs.push_back(pair.bodyA + " - " + pair.bodyB);
  return "swept: warning: in contact whatever group '" + checker.group().name +
         "' does, and left out of the verdicts: " + joined(pairs);
}

/// States of the command line, one problem or a request.
void checkStateSource(const Arguments& args) {
  requireOneSource(args);
  if (!args.request.empty()) return;
  if (args.problems.empty()) {
    if (args.states.empty()) throw UsageError(std::string(args.command->name) + ": no state given");
    return;
  }
  if (args.set.empty() || !args.index)
    throw UsageError(std::string(args.command->name) + ": --problems needs --set and --index");
}

Task problemTask(const Arguments& args, const Model& model, const Group& group,
                 Warnings& warnings) {
  const ProblemFile file = ProblemFile::load(args.problems);
  const PlanningProblem problem = file.problem(args.set, *args.index);
  const ProblemStates states = problemStates(*model.robot, group, problem, std::ref(warnings));
  Task task;
  task.alternatives = true;
  const auto world = std::make_shared<const World>(problem.world);
  if (args.command == &kReplayCommand) {
    // The rules are those of a run over many problems.
    const Arguments all;
    requireBodiesOfRules(args, model, file, chosenProblems(file, all));
    task.checker = makeFirstChecker(args, model, group, world, warnings);
  } else {
    task.checker = makeChecker(args, model, group, world, warnings);
  }
  task.states.push_back({.label = "start", .q = states.start});
  for (std::size_t i = 0; i < states.goals.size(); ++i) {
    const std::string number = states.goals.size() > 1 ? " " + std::to_string(i + 1) : "";
    task.states.push_back({.label = "goal" + number, .q = states.goals[i]});
  }
  return task;
}

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

/// The start's values of all joints, those outside the group too: they have limits as well, and are
/// taken to them as the group's are.
Eigen::VectorXd referenceOf(const Robot& robot, const PlanningRequest::JointValues& start,
                            const std::string& file, const Warn& warn) {
  Eigen::VectorXd reference = robot.defaultState();
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

Task requestTask(const Arguments& args, const Model& model, Warnings& warnings) {
  const PlanningRequest request = PlanningRequest::load(args.request, model.options);
  const Robot& robot = *model.robot;
  const std::string wanted = args.group.empty() ? request.group : args.group;
  const Group& group = chooseGroup(robot, wanted);
  if (request.goals.size() + request.poseGoals.size() > 1 && !request.poseGoals.empty())
    throw UsageError(args.request + ": a goal pose has to be its only goal");
  const PlanningRequest::JointValues start = startOf(robot, request, args.request);
  const auto stateOf = [&](const PlanningRequest::JointValues& values, const std::string& label) {
    return requestState(robot, group, values, args.request + ", " + label, std::ref(warnings));
  };
  Task task;
  task.alternatives = true;
  task.checker = makeChecker(args, model, group, model.world, warnings,
                             referenceOf(robot, start, args.request, std::ref(warnings)));
  task.states.push_back({.label = "start", .q = stateOf(start, "start")});
  for (std::size_t i = 0; i < request.goals.size(); ++i) {
    const std::string goal =
        request.goals.size() > 1 ? "goal " + std::to_string(i + 1) : std::string("goal");
    task.states.push_back({.label = goal, .q = stateOf(request.goals[i], goal)});
  }
  if (!request.poseGoals.empty()) task.poseGoal = request.poseGoals.front();
  return task;
}

}  // namespace

SrdfChoice chooseSrdf(const Arguments& args) {
  if (args.srdf == "none") return {};
  if (!args.srdf.empty()) return {.file = args.srdf, .foundBesideUrdf = false};
  const std::string beside = Robot::srdfBeside(args.robot).string();
  return {.file = beside, .foundBesideUrdf = !beside.empty()};
}

Model loadModel(const Arguments& args, Warnings& warnings) {
  LoadOptions options{
      .packages = packageFolders(args),
      .modelFrame = {},
      .warn = [&](const std::string& line) { warnings(line); },
      .warnOfUnchecked = [&](const std::string& line) { warnings.ofUnchecked(line); }};
  Model model;
  model.srdf = chooseSrdf(args);
  model.robot = args.xacro ? loadExpanded(args, model.srdf.file, options)
                           : Robot::load(args.robot, model.srdf.file, options);
  options.modelFrame = model.robot->links().front().name;
  World world = args.scene.empty() ? World{} : World::load(args.scene, options);
  addClouds(args, *model.robot, options, world);
  model.attached = attachedBodies(args, *model.robot, options);
  model.options = options;
  model.world = std::make_shared<const World>(std::move(world));
  return model;
}

const Group& chooseGroup(const Robot& robot, const std::string& name) {
  std::vector<std::string> names;
  for (const Group& group : robot.groups()) names.push_back(group.name);
  if (name.empty()) {
    if (robot.groups().size() == 1) return robot.groups().front();
    throw UsageError("robot '" + robot.name() +
                     "' has several groups; choose one with --group: " + joined(names));
  }
  if (const Group* group = robot.findGroup(name)) return *group;
  throw UsageError("robot '" + robot.name() + "' has no group '" + name + "'; it has " +
                   joined(names));
}

namespace {

/// `alone`: nothing else goes on that shows on the terminal.
std::shared_ptr<const Checker> makeCheckerWith(
    const CollisionRules& rules, const Arguments& args, const Model& model, const Group& group,
    std::shared_ptr<const World> world, Warnings& warnings, bool alone,
    const std::optional<Eigen::VectorXd>& reference = {}) {
  if (group.variables.empty())
    throw UsageError("group '" + group.name + "' has no joint that moves");
  CheckerOptions options;
  options.margin = args.margin;
  options.tolerance = args.tolerance;
  options.rules = rules;
  options.attached = model.attached;
  options.reference = reference;
  std::shared_ptr<const Checker> checker;
  try {
    const std::string links = std::to_string(model.robot->links().size());
    Progress progress("building the checker of " + links + " links", args.quiet || !alone);
    checker = std::make_shared<const Checker>(model.robot, group.name, std::move(world), options);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  if (!checker->standingContacts().empty()) warnings(standingContactText(*checker));
  return checker;
}

}  // namespace

std::shared_ptr<const Checker> makeChecker(const Arguments& args, const Model& model,
                                           const Group& group, std::shared_ptr<const World> world,
                                           Warnings& warnings,
                                           const std::optional<Eigen::VectorXd>& reference) {
  return makeCheckerWith(rulesOf(args), args, model, group, std::move(world), warnings, true,
                         reference);
}

std::shared_ptr<const Checker> makeFirstChecker(const Arguments& args, const Model& model,
                                                const Group& group,
                                                std::shared_ptr<const World> world,
                                                Warnings& warnings) {
  const CollisionRules rules = rulesIn(*world, rulesOf(args), *model.robot, model.attached);
  return makeCheckerWith(rules, args, model, group, std::move(world), warnings, false);
}

std::shared_ptr<const Checker> makeNextChecker(const Arguments& args, const Checker& like,
                                               std::shared_ptr<const World> world,
                                               Warnings& warnings) {
  CollisionRules rules = rulesIn(*world, rulesOf(args), like.robot(), like.options().attached);
  auto checker = std::make_shared<const Checker>(like.withWorld(std::move(world)));
  // What it has kept of its own rules are some of these.
  if (checker->options().rules.rules().size() != rules.rules().size())
    checker = std::make_shared<const Checker>(checker->withRules(std::move(rules)));
  if (!checker->standingContacts().empty()) warnings(standingContactText(*checker));
  return checker;
}

std::shared_ptr<const Checker> makeCheckerOfGroup(const Arguments& args, const Model& model,
                                                  Warnings& warnings) {
  if (args.group.empty() && model.robot->groups().size() > 1) return nullptr;
  const Group& group = chooseGroup(*model.robot, args.group);
  if (args.group.empty() && group.variables.empty()) return nullptr;
  return makeChecker(args, model, group, model.world, warnings);
}

double clearanceAccuracy(const Checker& checker) {
  return std::max(0.1 * checker.options().tolerance, kLeastAccuracy);
}

namespace {

Task statesTask(const Arguments& args, const Model& model, const Group& group, Warnings& warnings) {
  Task task;
  const bool plan = args.command == &kPlanCommand;
  for (std::size_t i = 0; i < args.states.size(); ++i) {
    const std::string& text = args.states[i];
    const std::string goal = args.states.size() > 2 ? "goal " + std::to_string(i) : "goal";
    const std::string label = plan ? (i == 0 ? "start" : goal) : "state " + std::to_string(i + 1);
    const std::vector<double> q = readState(*model.robot, group, text, label, std::ref(warnings));
    const bool named = model.robot->findNamedState(text, group.name) != nullptr;
    task.states.push_back({.label = named ? label + " (" + text + ")" : label, .q = q});
  }
  task.checker = makeChecker(args, model, group, model.world, warnings);
  return task;
}

Task anyTask(const Arguments& args, const Model& model, Warnings& warnings) {
  if (!args.request.empty()) return requestTask(args, model, warnings);
  const Group& group = chooseGroup(*model.robot, args.group);
  return args.problems.empty() ? statesTask(args, model, group, warnings)
                               : problemTask(args, model, group, warnings);
}

}  // namespace

Task loadTask(const Arguments& args, const Model& model, Warnings& warnings) {
  checkStateSource(args);
  Task task = anyTask(args, model, warnings);
  warnOfNothing(*task.checker, warnings);
  return task;
}

}  // namespace swept
