// SPDX-License-Identifier: BSD-3-Clause
#include "plan/planning.hpp"

#include <ompl/base/goals/GoalStates.h>
#include <ompl/util/Console.h>
#include <ompl/util/Exception.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "output/text_output.hpp"
#include "plan/planners.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

class StderrMessages : public ompl::msg::OutputHandler {
 public:
  void log(const std::string& text, ompl::msg::LogLevel, const char*, int) override {
    std::fprintf(stderr, "ompl: %s\n", text.c_str());
  }
};

/// Why a state cannot be an end of a path; empty when it can.
struct EndProblem {
  Verdict verdict = Verdict::Undecided;
  std::string text;
};

EndProblem endProblem(const Checker& checker, const LabelledState& state, Workspace& workspace) {
  const StateReport report = checker.reportState(state.q, workspace);
  if (report.verdict == Verdict::Free) return {.verdict = Verdict::Free, .text = {}};
  std::string text =
      state.label + " is " + (report.verdict == Verdict::Collision ? "in collision" : "undecided");
  if (!report.contacts.empty()) text.append(", ").append(witnessText(report.contacts.front()));
  return {.verdict = report.verdict, .text = std::move(text)};
}

/// The ends a planner can use: the start and the goals that are free.
struct Ends {
  const LabelledState* start = nullptr;
  std::vector<const LabelledState*> goals;
  ExitCode code = ExitCode::Free;
  std::string failure;  ///< why there is no such pair of ends
};

Ends usableEnds(const Checker& checker, const std::vector<LabelledState>& states) {
  Workspace workspace(checker);
  Ends ends;
  const auto refuse = [&](const EndProblem& problem) {
    ends.code = worse(ends.code, exitCodeOf(problem.verdict));
    ends.failure += (ends.failure.empty() ? "" : "; ") + problem.text;
  };
  const EndProblem startProblem = endProblem(checker, states.front(), workspace);
  if (!startProblem.text.empty()) refuse(startProblem);
  ends.start = &states.front();
  std::vector<EndProblem> goalProblems;
  for (std::size_t i = 1; i < states.size(); ++i) {
    EndProblem problem = endProblem(checker, states[i], workspace);
    if (problem.text.empty())
      ends.goals.push_back(&states[i]);
    else
      goalProblems.push_back(std::move(problem));
  }
  if (ends.goals.empty()) std::ranges::for_each(goalProblems, refuse);
  return ends;
}

void setEnds(og::SimpleSetup& setup, const StateConversion& conversion, const Ends& ends) {
  ob::ScopedState<> state(setup.getStateSpace());
  conversion.toState(ends.start->q, state.get());
  setup.setStartState(state);
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
  const StateConversion conversion(checker.robot(), checker.group());
  for (std::size_t i = 0; i < path.getStateCount(); ++i) {
    std::vector<double> q(static_cast<std::size_t>(checker.dimension()));
    conversion.toConfiguration(path.getState(static_cast<unsigned>(i)), q);
    outcome.states.push_back(std::move(q));
  }
  outcome.code = ExitCode::Free;
  Workspace workspace(checker);
  for (std::size_t i = 0; i + 1 < outcome.states.size(); ++i) {
    const std::vector<double>& from = outcome.states[i];
    const std::vector<double>& to = outcome.states[i + 1];
    PathSegment segment{.certificate = checker.certifyMotion(from, to, workspace),
                        .clearance = 0.0};
    if (clearance && segment.certificate.verdict == Verdict::Free)
      segment.clearance =
          checker.motionClearance(from, to, clearanceAccuracy(checker), workspace).lower;
    outcome.code = worse(outcome.code, exitCodeOf(segment.certificate.verdict));
    outcome.segments.push_back(std::move(segment));
  }
}

PlanOutcome solve(og::SimpleSetup& setup, const Checker& checker, const PlanRequest& request) {
  PlanOutcome outcome;
  const ob::PlannerStatus status = setup.solve(request.time);
  if (status == ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE)
    throw UsageError("planner " + request.planner + " takes one goal only");
  outcome.planningTime = setup.getLastPlanComputationTime();
  const bool exact = status == ob::PlannerStatus::EXACT_SOLUTION;
  if (exact && request.simplify) {
    setup.simplifySolution(request.time);
    outcome.simplifyTime = setup.getLastSimplificationTime();
  }
  const ob::MotionValidatorPtr& validator = setup.getSpaceInformation()->getMotionValidator();
  outcome.certified = validator->getValidMotionCount();
  outcome.refused = validator->getInvalidMotionCount();
  if (!exact) {
    outcome.failure =
        "no path after " + secondsText(outcome.planningTime) + " (" + status.asString() + ")";
    return outcome;
  }
  outcome.length = setup.getSolutionPath().length();
  certify(outcome, checker, setup.getSolutionPath(), request.clearance);
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

PlanOutcome plan(const std::shared_ptr<const Checker>& checker,
                 const std::vector<LabelledState>& states, const PlanRequest& request) {
  const Ends ends = usableEnds(*checker, states);
  if (!ends.failure.empty()) {
    PlanOutcome outcome;
    outcome.code = ends.code;
    outcome.failure = ends.failure;
    return outcome;
  }
  // Spaces and planners draw from the seed as soon as they are made.
  ompl::RNG::setSeed(request.seed);
  const og::SimpleSetupPtr setup = makeSimpleSetup(checker);
  const StateConversion conversion(checker->robot(), checker->group());
  setEnds(*setup, conversion, ends);
  try {
    setup->getSpaceInformation()->setup();
    setup->setPlanner(makePlanner(request.planner, setup->getSpaceInformation()));
    setup->setup();
    return solve(*setup, *checker, request);
  } catch (const ompl::Exception& error) {
    throw UsageError("planner " + request.planner + ": " + error.what());
  }
}

void routePlannerMessages(bool toStderr) {
  static StderrMessages messages;
  if (toStderr)
    ompl::msg::useOutputHandler(&messages);
  else
    ompl::msg::noOutputHandler();
}

}  // namespace swept
