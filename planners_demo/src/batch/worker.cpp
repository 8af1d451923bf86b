// SPDX-License-Identifier: BSD-3-Clause
#include "batch/worker.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>

#include "batch/validator.hpp"
#include "input/states.hpp"
#include "plan/plan_dump.hpp"
#include "verify/encoding.hpp"

namespace swept {
namespace {

std::string digestOf(const std::vector<std::vector<double>>& states) {
  std::string numbers;
  for (const std::vector<double>& q : states) numbers += verify::base64Of(q) + " ";
  return verify::digestOf(numbers);
}

PathFacts factsOf(const PlanOutcome& outcome, const BatchArguments& args) {
  PathFacts path;
  path.length = outcome.length;
  path.segments = static_cast<int>(outcome.segments.size());
  for (const PathSegment& segment : outcome.segments) {
    path.missedCollisions += segment.certificate.verdict == Verdict::Collision ? 1 : 0;
    path.undecided += segment.certificate.verdict == Verdict::Undecided ? 1 : 0;
  }
  path.certified = outcome.proven();
  if (path.certified && !args.noClearance) {
    const auto finite = [](const NearestPair& pair) {
      return std::isfinite(pair.clearance) ? std::optional(pair) : std::nullopt;
    };
    const Clearances least = outcome.leastClearances();
    path.world = finite(least.world);
    path.self = finite(least.self);
    if (std::isfinite(outcome.leastClearance())) path.clearance = outcome.leastClearance();
  }
  path.digest = digestOf(outcome.states);
  if (args.states) path.states = outcome.states;
  return path;
}

/// Without the time that it took, which differs from run to run.
std::string failureOf(const PlanOutcome& outcome) {
  return outcome.status.empty() ? outcome.failure : "no path (" + outcome.status + ")";
}

}  // namespace

Worker::Worker(const Batch& batch, Warnings::Taker warnings)
    : batch_(batch),
      group_(chooseGroup(*batch.model.robot, batch.group)),
      warnings_(std::move(warnings)),
      dump_(*batch.args),
      like_(makeFirstChecker(*batch.args, batch.model, group_, std::make_shared<const World>(),
                             warnings_)) {
  dump_.requireNames(*like_);
}

const std::shared_ptr<const Checker>& Worker::checkerOf(const PlanningProblem& problem) {
  if (!checker_ || set_ != problem.set || index_ != problem.index) {
    checker_ = makeNextChecker(*batch_.args, batch_.model, *like_,
                               std::make_shared<const World>(problem.world), warnings_);
    set_ = problem.set;
    index_ = problem.index;
  }
  return checker_;
}

/// A result is valid without it.
void Worker::dump(const RunKey& key, const PlanOutcome& outcome) {
  try {
    dump_.setProblem(key.set, key.index);
    dumpFailures(dump_, *like_, outcome);
  } catch (const std::exception& error) {
    warnings_(std::string("swept: warning: ") + error.what());
  }
}

RunResult Worker::run(const RunKey& key) {
  RunResult result;
  result.key = key;
  std::atomic<std::uint64_t> statesChecked = 0;
  const Arguments& args = *batch_.args;
  const Validator validator = readValidator(key.validator, largestMargin(args));
  const PlanRequest request{.planner = key.planner,
                            .time = args.time,
                            .seed = key.seed,
                            .simplify = !args.noSimplify,
                            .clearance = !args.batch.noClearance,
                            .setup = setupMaker(validator, statesChecked)};
  PlanOutcome outcome;
  try {
    const PlanningProblem problem = batch_.problems->problem(key.set, key.index);
    const ProblemStates ends =
        problemStates(*batch_.model.robot, group_, problem, std::ref(warnings_));
    std::vector<LabelledState> states{{.label = "start", .q = ends.start}};
    for (const std::vector<double>& q : ends.goals) states.push_back({.label = "goal", .q = q});
    outcome = plan(checkerOf(problem), states, request);
  } catch (const std::exception& error) {
    // Values outside the limits, a planner that needs more than a space, or lack of memory do not
    // stop the other runs.
    outcome.failure = error.what();
  }
  dump(key, outcome);
  result.status = outcome.status;
  result.failure = outcome.solved() ? "" : failureOf(outcome);
  if (outcome.solved() || outcome.status.empty() || !args.batch.noTimes) {
    result.statesChecked = statesChecked;
    result.motionsChecked = std::uint64_t{outcome.certified} + outcome.refused;
  }
  if (outcome.solved()) result.path = factsOf(outcome, args.batch);
  if (!args.batch.noTimes)
    result.times = RunTimes{.planning = outcome.planningTime,
                            .simplification = outcome.simplifyTime,
                            .certification = outcome.certifyTime};
  return result;
}

}  // namespace swept
