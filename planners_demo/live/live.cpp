// SPDX-License-Identifier: BSD-3-Clause
/// Verdicts in a browser: what `swept check` says of a state, as a WebAssembly module. JavaScript
/// calls the three functions below; each answers with JSON, whose text is there until the next
/// call. Files are those of Emscripten's file system, in memory.
#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "check/state_report.hpp"
#include "command_line/exit_code.hpp"
#include "input/constraints.hpp"
#include "input/groups.hpp"
#include "input/inputs.hpp"
#include "input/problem_choice.hpp"
#include "input/states.hpp"
#include "input/task.hpp"
#include "io/json_value.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/problems.hpp"

namespace swept {
namespace {

struct Live {
  std::shared_ptr<const Checker> checker;
  std::unique_ptr<Workspace> workspace;
  std::string answer;
};

Live& live() {
  static Live one;
  return one;
}

const char* answer(const Json& json) {
  live().answer = dumped(json);
  return live().answer.c_str();
}

template <typename Ask>
const char* answerOrError(const Ask& ask) {
  try {
    return answer(ask());
  } catch (const std::exception& error) {
    return answer({{"error", error.what()}});
  }
}

/// The checker of `swept check` with these inputs. `remarks` gets what it warns of.
std::shared_ptr<const Checker> checkerOf(const Arguments& args, std::vector<std::string>& remarks) {
  if (!args.request.empty()) throw UsageError("a planning request is not read here");
  Warnings warnings([&](const std::string& line) { remarks.push_back(line); });
  const Model model = loadModel(args, warnings);
  const Group& group = chooseGroup(*model.robot, args);
  std::shared_ptr<const World> world = model.world;
  std::vector<double> start;
  if (!args.problems.empty()) {
    const ProblemFile file = ProblemFile::load(args.problems);
    const PlanningProblem problem =
        chosenProblem(file, args.problems, args.set, args.index.value_or(0));
    start = problemStates(*model.robot, group, problem, [](const std::string&) {}).start;
    world = std::make_shared<const World>(problem.world);
  } else if (!args.states.empty()) {
    start = readState(*model.robot, group, args.states.front(), "state", [](const std::string&) {});
  }
  auto checker = makeChecker(args, model, group, std::move(world), warnings);
  return start.empty() ? checker : withConstraintsOf(args, std::move(checker), start);
}

}  // namespace
}  // namespace swept

extern "C" {

/// Reads the robot, its scene and the options from `file`, which has the `inputs` of a path file.
/// Answers `{"variables": [names], "remarks": [lines]}`, or `{"error": text}`; then what was open
/// before stays open.
const char* swept_live_open(const char* file) {
  using namespace swept;
  return answerOrError([&]() -> Json {
    const std::string name = file;
    const Json inputs = JsonValue::parseFile(name);
    std::vector<std::string> remarks;
    Arguments args = inputsOf(JsonValue(inputs, "inputs", name));
    args.quiet = true;  // no line that tells how far it is: nobody sees one
    auto checker = checkerOf(args, remarks);
    live().workspace = std::make_unique<Workspace>(*checker);
    live().checker = std::move(checker);
    const Checker& opened = *live().checker;
    return {{"variables", variableNames(opened.robot(), opened.group())}, {"remarks", remarks}};
  });
}

/// What `swept check --json` says of a state with these `count` values (rad, m): verdict, contacts,
/// clearances.
const char* swept_live_report(const double* values, int count) {
  using namespace swept;
  return answerOrError([&]() -> Json {
    if (live().checker == nullptr) throw UsageError("no robot is open");
    const LabelledState state{.label = "state", .q = {values, values + count}};
    return reportJson(state, live().checker->reportState(state.q, *live().workspace),
                      live().checker->options().constraints);
  });
}

/// The verdict alone, of checkState(): `{"verdict": "free"}`.
const char* swept_live_verdict(const double* values, int count) {
  using namespace swept;
  return answerOrError([&]() -> Json {
    if (live().checker == nullptr) throw UsageError("no robot is open");
    const std::span<const double> q(values, static_cast<std::size_t>(count));
    return {{"verdict", toString(live().checker->checkState(q, *live().workspace))}};
  });
}

}  // extern "C"
