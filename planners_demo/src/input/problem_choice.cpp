// SPDX-License-Identifier: BSD-3-Clause
#include "input/problem_choice.hpp"

#include <algorithm>

#include "swept/robot_model/did_you_mean.hpp"
#include "command_line/exit_code.hpp"
#include "input/rules.hpp"
#include "swept/robot_model/input.hpp"

namespace swept {

PlanningProblem chosenProblem(const ProblemFile& file, const std::string& name,
                              const std::string& set, int index) {
  const std::vector<std::string> sets = file.sets();
  try {
    return file.problem(set, index);
  } catch (const InputError& error) {
    // The file's own message names the sets it has.
    if (std::ranges::find(sets, set) != sets.end()) throw;
    throw InputError(name, 0, error.message() + didYouMean(set, sets));
  }
}

std::vector<ProblemChoice> chosenProblems(const ProblemFile& file, const Arguments& args) {
  std::vector<ProblemChoice> chosen;
  int place = 0;
  for (const std::string& set : file.sets()) {
    if (!args.set.empty() && set != args.set) continue;
    for (const int index : file.indices(set))
      if (place++ % args.report.every == 0) chosen.push_back({.set = set, .index = index});
  }
  if (chosen.empty() && !args.set.empty()) chosenProblem(file, args.problems, args.set, 0);
  if (chosen.empty()) throw UsageError("'" + args.problems + "' has no problems");
  if (args.limit && chosen.size() > static_cast<std::size_t>(*args.limit))
    chosen.resize(static_cast<std::size_t>(*args.limit));
  return chosen;
}

void requireBodiesOfRules(const Arguments& args, const Model& model, const ProblemFile& file,
                          const std::vector<ProblemChoice>& chosen) {
  NamesOfBodies names(rulesOf(args), *model.robot, model.attached);
  for (const ProblemChoice& choice : chosen) {
    if (names.empty()) return;
    names.find(file.problem(choice.set, choice.index).world);
  }
  names.requireFound("the world of any chosen problem");
}

void requireOneSource(const Arguments& args) {
  if (!args.request.empty() && !(args.states.empty() && args.problems.empty()))
    throw UsageError("--request cannot be combined with states or --problems: it has its own");
  if (args.problems.empty()) return;
  if (!args.states.empty())
    throw UsageError("states and --problems cannot be combined: the problem has its own");
  if (!args.scene.empty())
    throw UsageError("--scene and --problems cannot be combined: the problem has its own world");
  if (!args.clouds.empty())
    throw UsageError("--cloud and --problems cannot be combined: the problem has its own world");
}

}  // namespace swept
