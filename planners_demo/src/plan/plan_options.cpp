// SPDX-License-Identifier: BSD-3-Clause
#include "plan/plan_options.hpp"

#include <filesystem>
#include <string>
#include <utility>

#include "command_line/exit_code.hpp"
#include "input/problem_choice.hpp"

namespace swept {
namespace {

void requireGoalPose(const Arguments& args) {
  if (!args.goalPose.empty()) {
    if (!args.request.empty())
      throw UsageError(
          "--goal-pose and --request cannot be combined: the request has its own goals");
    if (!args.problems.empty())
      throw UsageError(
          "--goal-pose and --problems cannot be combined: the problem has its own goals");
    return;
  }
  if (!args.goalLink.empty()) throw UsageError("--link needs --goal-pose");
  if (args.positionTolerance) throw UsageError("--position-tolerance needs --goal-pose");
  if (args.orientationTolerance) throw UsageError("--orientation-tolerance needs --goal-pose");
}

void requireOneProblemOrSeveral(const Arguments& args) {
  if (!plansSeveral(args)) {
    if (args.jobs > 1)
      throw UsageError("--jobs plans several problems at the same time; here is one");
    return;
  }
  if (args.index) throw UsageError("--index needs --set");
  if (!args.output.empty())
    throw UsageError("-o writes one path; choose one problem with --set and --index");
  if (!args.page.file.empty())
    throw UsageError("--html shows one problem: it needs --set and --index");
  for (const auto& [option, texts] :
       {std::pair{"--keep-upright", &args.keepUpright}, std::pair{"--keep-level", &args.keepLevel},
        std::pair{"--stay-in", &args.stayIn}, std::pair{"--stay-on", &args.stayOn}})
    if (!texts->empty())
      throw UsageError(std::string(option) +
                       " is for one problem; choose one with --set and --index");
  if (args.timing.timed)
    throw UsageError("--timed makes one trajectory; choose one problem with --set and --index");
}

void requireEnds(const Arguments& args) {
  if (!args.request.empty() || !args.problems.empty()) return;
  if (!args.goalPose.empty() && args.states.size() != 1)
    throw UsageError("plan: with --goal-pose a start is needed, and no other state");
  if (args.goalPose.empty() && args.states.size() < 2)
    throw UsageError("plan: a start and a goal are needed");
}

}  // namespace

bool plansSeveral(const Arguments& args) {
  return !args.problems.empty() && (args.set.empty() || !args.index);
}

void requirePlanOptions(const Arguments& args) {
  requireOneSource(args);
  requireGoalPose(args);
  requireOneProblemOrSeveral(args);
  if (args.embed && std::filesystem::path(args.output).extension() != ".json")
    throw UsageError("--embed needs -o FILE.json");
  if (args.simplifyTime && args.noSimplify)
    throw UsageError("--simplify and --no-simplify cannot be combined");
  requireEnds(args);
}

}  // namespace swept
