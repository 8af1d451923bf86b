// SPDX-License-Identifier: BSD-3-Clause
/// Verdicts in a browser: what `swept check` says of a state, as a WebAssembly module. JavaScript
/// calls the functions below; each answers with JSON, whose text is there until the next
/// call. Files are those of Emscripten's file system, in memory.
#include <Eigen/Geometry>
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
#include "swept/robot_model/world.hpp"

namespace swept {
namespace {

struct Live {
  World given;  ///< the bodies where the files have them
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

void use(std::shared_ptr<const Checker> checker) {
  live().workspace = std::make_unique<Workspace>(*checker);
  live().checker = std::move(checker);
}

const Checker& opened() {
  if (live().checker == nullptr) throw UsageError("no robot is open");
  return *live().checker;
}

/// From a position (m) and a quaternion (x, y, z, w), seven numbers.
Eigen::Isometry3d poseFrom(const double* numbers) {
  const Eigen::Quaterniond turn(numbers[6], numbers[3], numbers[4], numbers[5]);
  return Eigen::Translation3d(numbers[0], numbers[1], numbers[2]) * turn.normalized();
}

Json poseJson(const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d position = pose.translation();
  const Eigen::Quaterniond turn(pose.linear());
  return {{"position", {position.x(), position.y(), position.z()}},
          {"orientation", {turn.x(), turn.y(), turn.z(), turn.w()}}};
}

/// The body with each of its parts moved by the same.
WorldBody movedBy(const Eigen::Isometry3d& motion, WorldBody body) {
  for (WorldBody::Part& part : body.parts) {
    part.world_from_shape = motion * part.world_from_shape;
  }
  return body;
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
    use(std::move(checker));
    const Checker& now = opened();
    live().given = now.world();
    return {{"variables", variableNames(now.robot(), now.group())}, {"remarks", remarks}};
  });
}

/// What `swept check --json` says of a state with these `count` values (rad, m): verdict, contacts,
/// clearances.
const char* swept_live_report(const double* values, int count) {
  using namespace swept;
  return answerOrError([&]() -> Json {
    const Checker& now = opened();
    const LabelledState state{.label = "state", .q = {values, values + count}};
    return reportJson(state, now.reportState(state.q, *live().workspace),
                      now.options().constraints);
  });
}

/// The verdict alone, of checkState(): `{"verdict": "free"}`.
const char* swept_live_verdict(const double* values, int count) {
  using namespace swept;
  return answerOrError([&]() -> Json {
    const Checker& now = opened();
    const std::span<const double> q(values, static_cast<std::size_t>(count));
    return {{"verdict", toString(now.checkState(q, *live().workspace))}};
  });
}

/// Moves a body of the world away from where its file has it: by a position (m) and a quaternion
/// (x, y, z, w), the seven numbers of `motion`, in the model frame. Answers with where its parts
/// then are, `{"parts": [{"position": [x, y, z], "orientation": [x, y, z, w]}]}`. After an
/// `{"error": text}` it is where it was.
const char* swept_live_move(const char* body, const double* motion) {
  using namespace swept;
  return answerOrError([&]() -> Json {
    const Checker& now = opened();
    const WorldBody* const given = live().given.find(body);
    if (given == nullptr) throw UsageError("the world has no body '" + std::string(body) + "'");
    WorldBody moved = movedBy(poseFrom(motion), *given);
    Json parts = Json::array();
    for (const WorldBody::Part& part : moved.parts) {
      parts.push_back(poseJson(part.world_from_shape));
    }
    use(std::make_shared<const Checker>(now.withReplaced(std::move(moved))));
    return {{"parts", std::move(parts)}};
  });
}

}  // extern "C"
