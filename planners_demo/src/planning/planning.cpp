// SPDX-License-Identifier: BSD-3-Clause
#include "planning/planning.hpp"

#include <ompl/base/goals/GoalStates.h>
#include <ompl/util/Console.h>
#include <ompl/util/Exception.h>
#include <ompl/util/RandomNumbers.h>

#include <ompl/tools/multiplan/ParallelPlan.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>

#include "output/seconds_since.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/ompl_bridge/planners.hpp"
#include "swept/robot_model/did_you_mean.hpp"
#include "swept/robot_model/foreign_text.hpp"

namespace swept {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

/// What planners say. When one of its threads fails, CForest of OMPL 1.6 says so and no more: to
/// its caller it has found no path.
class PlannerMessages : public ompl::msg::OutputHandler {
 public:
  bool toStderr = false;
  std::string failure;  ///< of the last thread that failed

  /// OMPL calls this one message at a time.
  void log(const std::string& text, ompl::msg::LogLevel, const char*, int) override {
    if (toStderr) printMessage("ompl: " + foreignText(text));
    const std::string_view front = "Exception thrown during CForest::solve: ";
    if (text.starts_with(front)) failure = text.substr(front.size());
  }
};

PlannerMessages& plannerMessages() {
  static PlannerMessages messages;
  return messages;
}

/// The ends a planner can use: the start and the goals that are free.
struct Ends {
  const LabelledState* start = nullptr;
  std::vector<const LabelledState*> goals;
  ExitCode code = ExitCode::Free;
  std::string failure;  ///< why there is no such pair of ends
  std::vector<EndReport> bad;
};

Ends usableEnds(const Checker& checker, const std::vector<LabelledState>& states,
                const PlanRequest& request) {
  Workspace workspace(checker);
  Ends ends;
  const auto refuse = [&](const EndReport& report) {
    ends.code = worse(ends.code, exitCodeOf(report.verdict));
    ends.failure += (ends.failure.empty() ? "" : "; ") + endText(report);
    ends.bad.push_back(report);
  };
  const EndReport start = reportEnd(checker, states.front(), workspace);
  if (start.verdict != Verdict::Free) refuse(start);
  ends.start = &states.front();
  std::vector<EndReport> badGoals;
  for (std::size_t i = 1; i < states.size(); ++i) {
    EndReport goal = reportEnd(checker, states[i], workspace);
    if (goal.verdict == Verdict::Free)
      ends.goals.push_back(&states[i]);
    else
      badGoals.push_back(std::move(goal));
  }
  if (ends.goals.empty() && !request.goalPose) std::ranges::for_each(badGoals, refuse);
  return ends;
}

/// What the planner may use of a floor or a space that has no end: it holds both ends.
StateSpaceOptions spaceAround(const Checker& checker, const Ends& ends,
                              const PlanRequest& request) {
  std::vector<std::vector<double>> held{ends.start->q};
  for (const LabelledState* goal : ends.goals) held.push_back(goal->q);
  if (request.goalPose) {
    // How far from the link the base will be is not known: as far as both are from the origin.
    const double away = request.goalPose->model_from_link.translation().norm();
    for (const double value : {-away, away}) {
      std::vector<double> q = ends.start->q;
      const std::vector<int>& variables = checker.group().variables;
      for (std::size_t i = 0; i < q.size(); ++i) {
        const Variable& variable = checker.robot().variables()[variables[i]];
        if (std::isinf(variable.lower) || std::isinf(variable.upper)) q[i] = value;
      }
      held.push_back(std::move(q));
    }
  }
  return {.limits = limitsAround(checker.robot(), checker.group(), held)};
}

/// Looks for goal states until it has enough or gives up, before the planner starts: what that
/// returns depends on the seed alone then.
std::shared_ptr<PoseGoal> sampledGoal(const og::SimpleSetup& setup,
                                      const std::shared_ptr<const Checker>& checker,
                                      const PoseTarget& target, std::uint32_t seed) {
  PoseGoalOptions options;
  options.positionTolerance = target.positionTolerance;
  options.orientationTolerance = target.orientationTolerance;
  options.seed = seed;
  std::shared_ptr<PoseGoal> goal;
  try {
    goal = std::make_shared<PoseGoal>(setup.getSpaceInformation(), checker, target.link,
                                      target.model_from_link, options);
  } catch (const std::invalid_argument& error) {
    std::vector<std::string> links;
    for (const Link& link : checker->robot().links()) links.push_back(link.name);
    const bool known = std::ranges::find(links, target.link) != links.end();
    throw UsageError(std::string("--goal-pose: ") + error.what() +
                     (known ? "" : didYouMean(target.link, links)));
  }
  goal->startSampling();
  while (goal->isSampling()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return goal;
}

/// Some of OMPL's planners have threads, under one of these names.
bool setThreads(ob::Planner& planner, int threads) {
  for (const char* name : {"thread_count", "num_threads", "num_planners"})
    if (planner.params().hasParam(name))
      return planner.params().setParam(name, std::to_string(threads));
  return false;
}

/// Longest motion of a planner of OMPL, in the metric of the space, where its own default will not
/// do; empty up to seven variables. OMPL's is a fifth of the extent of the space, which grows with
/// their number: arms side by side hardly ever move free by so much at a time. This is a fifth of
/// the root mean square of what the variables reach.
std::optional<double> defaultRange(const ob::StateSpace& space) {
  constexpr unsigned kOneArm = 7;
  const unsigned count = space.getDimension();
  if (count <= kOneArm) return std::nullopt;
  return 0.2 * space.getMaximumExtent() / std::sqrt(static_cast<double>(count));
}

/// False for planners that have no such parameter.
bool setRange(ob::Planner& planner, double range) {
  return planner.params().hasParam("range") &&
         planner.params().setParam("range", exactNumber(range));
}

/// `copy`: of several that run side by side, which.
ob::PlannerPtr plannerOf(const og::SimpleSetup& setup, const PlanRequest& request, int copy = 0) {
  ob::PlannerPtr planner = makePlanner(request.planner, setup.getSpaceInformation());
  std::optional<double> range = request.range;
  if (auto* own = dynamic_cast<CertifiedConnect*>(planner.get()))
    own->setSeed(request.seed + static_cast<std::uint32_t>(copy));
  else if (!range)
    range = defaultRange(*setup.getStateSpace());
  const bool isSet = range && setRange(*planner, *range);
  if (request.range && !isSet)
    throw UsageError("planner " + request.planner + " has no range; --range is for others");
  return planner;
}

/// Of the others as many run side by side, and the first path ends it.
ob::PlannerStatus solveInParallel(og::SimpleSetup& setup, const PlanRequest& request) {
  ompl::tools::ParallelPlan parallel(setup.getProblemDefinition());
  for (int i = 0; i < request.threads; ++i) parallel.addPlanner(plannerOf(setup, request, i));
  return parallel.solve(request.time, 1, 1, false);
}

void setEnds(og::SimpleSetup& setup, const StateConversion& conversion, const Ends& ends) {
  ob::ScopedState<> state(setup.getStateSpace());
  conversion.toState(ends.start->q, state.get());
  setup.setStartState(state);
  if (ends.goals.empty()) return;  // a goal pose
  if (ends.goals.size() == 1) {
    // Every planner takes a single state; a few take nothing else.
    conversion.toState(ends.goals.front()->q, state.get());
    setup.setGoalState(state);
    return;
  }
  auto goals = std::make_shared<ob::GoalStates>(setup.getSpaceInformation());
  for (const LabelledState* goal : ends.goals) {
    conversion.toState(goal->q, state.get());
    goals->addState(state);
  }
  setup.setGoal(goals);
}

void certify(PlanOutcome& outcome, const Checker& checker, const og::PathGeometric& path,
             bool clearance) {
  outcome.states = configurationsOf(path, checker);
  // Of a start that is the goal, some planners make a path of one state. What is to be proven of
  // it, and can be verified, is the motion that stays there.
  if (outcome.states.size() == 1) outcome.states.push_back(outcome.states.front());
  outcome.code = ExitCode::Free;
  Workspace workspace(checker);
  for (std::size_t i = 0; i + 1 < outcome.states.size(); ++i) {
    const std::vector<double>& from = outcome.states[i];
    const std::vector<double>& to = outcome.states[i + 1];
    PathSegment segment{.certificate = checker.certifyMotion(from, to, workspace),
                        .clearance = 0.0,
                        .clearances = {}};
    if (clearance && segment.certificate.verdict == Verdict::Free) {
      const MotionClearance found =
          checker.motionClearance(from, to, clearanceAccuracy(checker), workspace);
      segment.clearance = found.lower;
      segment.clearances = clearancesOf(found);
    }
    outcome.code = worse(outcome.code, exitCodeOf(segment.certificate.verdict));
    outcome.segments.push_back(std::move(segment));
  }
}

/// Returns the s that it took.
double simplify(og::SimpleSetup& setup, const PlanRequest& request) {
  if (request.simplifyTime) {
    setup.simplifySolution(*request.simplifyTime);
    return setup.getLastSimplificationTime();
  }
  const auto begin = std::chrono::steady_clock::now();
  shortenPath(setup.getSolutionPath());
  return secondsSince(begin);
}

PlanOutcome solve(og::SimpleSetup& setup, const Checker& checker, const PlanRequest& request) {
  PlanOutcome outcome;
  plannerMessages().failure.clear();
  const bool copies = request.threads > 1 && !setThreads(*setup.getPlanner(), request.threads);
  const auto begin = std::chrono::steady_clock::now();
  const ob::PlannerStatus status =
      copies ? solveInParallel(setup, request) : setup.solve(request.time);
  if (status == ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE)
    throw UsageError("planner " + request.planner + " takes one goal only");
  outcome.status = status.asString();
  outcome.planningTime = secondsSince(begin);
  const bool exact = status == ob::PlannerStatus::EXACT_SOLUTION;
  if (exact && request.simplify) outcome.simplifyTime = simplify(setup, request);
  const ob::MotionValidatorPtr& validator = setup.getSpaceInformation()->getMotionValidator();
  outcome.certified = validator->getValidMotionCount();
  outcome.refused = validator->getInvalidMotionCount();
  if (!exact) {
    const std::string& failure = plannerMessages().failure;
    if (!failure.empty())
      throw UsageError("planner " + request.planner + ": " + foreignText(failure));
    outcome.failure =
        "no path after " + secondsText(outcome.planningTime) + " (" + outcome.status + ")";
    return outcome;
  }
  outcome.length = setup.getSolutionPath().length();
  const auto found = std::chrono::steady_clock::now();
  certify(outcome, checker, setup.getSolutionPath(), request.clearance);
  outcome.certifyTime = secondsSince(found);
  return outcome;
}

}  // namespace

bool PlanOutcome::proven() const {
  return solved() && std::ranges::all_of(segments, [](const PathSegment& segment) {
           return segment.certificate.verdict == Verdict::Free;
         });
}

double PlanOutcome::leastClearance() const {
  double least = std::numeric_limits<double>::infinity();
  for (const PathSegment& segment : segments) least = std::min(least, segment.clearance);
  return least;
}

Clearances PlanOutcome::leastClearances() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Clearances least;
  least.world.clearance = least.self.clearance = kInfinity;
  for (const PathSegment& segment : segments) takeLeast(segment.clearances, least);
  return least;
}

PlanOutcome plan(const std::shared_ptr<const Checker>& checker,
                 const std::vector<LabelledState>& states, const PlanRequest& request) {
  const Ends ends = usableEnds(*checker, states, request);
  PlanOutcome outcome;
  if (!ends.failure.empty()) {
    outcome.code = ends.code;
    outcome.failure = ends.failure;
    outcome.badEnds = ends.bad;
    return outcome;
  }
  // Spaces and planners draw from the seed as soon as they are made.
  ompl::RNG::setSeed(request.seed);
  const StateSpaceOptions space = spaceAround(*checker, ends, request);
  const og::SimpleSetupPtr setup =
      request.setup ? request.setup(checker, space) : makeSimpleSetup(checker, {.space = space});
  const StateConversion conversion(checker->robot(), checker->group());
  setEnds(*setup, conversion, ends);
  try {
    setup->getSpaceInformation()->setup();
    if (request.goalPose) {
      const auto goal = sampledGoal(*setup, checker, *request.goalPose, request.seed);
      if (!goal->hasStates()) {
        outcome.failure = whyNotReached(checker, *request.goalPose, request.seed);
        return outcome;
      }
      setup->setGoal(goal);
    }
    setup->setPlanner(plannerOf(*setup, request));
    setup->setup();
    return solve(*setup, *checker, request);
  } catch (const ompl::Exception& error) {
    throw UsageError("planner " + request.planner + ": " + foreignText(error.what()));
  }
}

void routePlannerMessages(bool toStderr) {
  plannerMessages().toStderr = toStderr;
  ompl::msg::useOutputHandler(&plannerMessages());
}

}  // namespace swept
