// SPDX-License-Identifier: BSD-3-Clause
#include "input/task.hpp"

#include <functional>
#include <utility>

#include "command_line/commands.hpp"
#include "input/clock.hpp"
#include "input/constraints.hpp"
#include "input/problem_choice.hpp"
#include "input/request_task.hpp"
#include "input/state_lists.hpp"
#include "input/states.hpp"
#include "input/unchecked.hpp"
#include "swept/robot_model/named_states.hpp"

namespace swept {
namespace {

/// States of the command line, one problem or a request.
void checkStateSource(const Arguments& args) {
  requireOneSource(args);
  requireDegreesForValues(args);
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
  const PlanningProblem problem = chosenProblem(file, args.problems, args.set, *args.index);
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

Task statesTask(const Arguments& args, const Model& model, const Group& group, Warnings& warnings) {
  Task task;
  const bool plan = args.command == &kPlanCommand || args.command == &kRoadmapQueryCommand;
  const AngleUnit unit = args.degrees ? AngleUnit::Degree : AngleUnit::Radian;
  for (std::size_t i = 0; i < args.states.size(); ++i) {
    const std::string& text = args.states[i];
    if (args.command->takesLists && isStateList(text)) {
      addStateList(args, *model.robot, group, model.reference, model.options, text, task.states);
      continue;
    }
    const std::string goal = args.states.size() > 2 ? "goal " + std::to_string(i) : "goal";
    const std::string label = plan ? (i == 0 ? "start" : goal) : "state " + std::to_string(i + 1);
    const std::vector<double> q =
        readState(*model.robot, group, text, label, std::ref(warnings), unit);
    const bool named =
        text == kDefaultState || model.robot->findNamedState(text, group.name) != nullptr;
    task.states.push_back({.label = named ? label + " (" + text + ")" : label, .q = q});
  }
  task.checker = makeChecker(args, model, group, model.world, warnings);
  return task;
}

Task anyTask(const Arguments& args, const Model& model, Warnings& warnings) {
  if (!args.request.empty()) return requestTask(args, model, warnings);
  const Group& group = chooseGroup(*model.robot, args);
  return args.problems.empty() ? statesTask(args, model, group, warnings)
                               : problemTask(args, model, group, warnings);
}

}  // namespace

Task loadTask(const Arguments& args, const Model& model, Warnings& warnings) {
  checkStateSource(args);
  Task task = anyTask(args, model, warnings);
  task.checker = withConstraintsOf(args, task.checker, task.states.front().q, task.constraints);
  addTimes(args, task);
  warnOfNothing(*task.checker, warnings);
  return task;
}

}  // namespace swept
