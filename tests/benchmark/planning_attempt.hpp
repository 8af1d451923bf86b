// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planning_problems.hpp"
#include "planning_validity.hpp"

/// One problem, one way to tell what is valid: planning it, and what its path is worth.
namespace swept::benchmark {

/// How motions are validated.
struct Method {
  std::string name;
  /// Of OMPL's discrete validator over FCL, as a share of the space's extent; none: certified.
  std::optional<double> resolution;
  bool nearestStates = false;  ///< the planner's nearest neighbours are the bridge's, not OMPL's
};

/// Ours, ours with the planner as OMPL has it, OMPL's default, MoveIt's. FCL's columns are relative
/// to OMPL's default.
inline const std::vector<Method> kMethods{{"swept", {}, true},
                                          {"swept, OMPL's neighbours", {}},
                                          {"FCL, 1 %", 0.01},
                                          {"FCL, 0.5 %", 0.005}};
constexpr std::size_t kSwept = 0, kReference = 2;

/// What the exact checker says of a whole path.
struct PathJudgement {
  Verdict verdict = Verdict::Free;  ///< Collision if one of its segments is, else Undecided if one
  int segments = 0, colliding = 0;
  double stretch = 0.0;  ///< rad (L2), longest part in contact, by samples every kContactStep
  double depth = 0.0;    ///< m, of the hulls of the two that are deepest in each other
};

struct Attempt {
  bool solved = false;
  std::string status;
  double building = 0.0;  ///< s, CPU: objects of the world, checker, validator
  double seconds = 0.0;   ///< s, CPU: planning, without the meter's own
  double share = 0.0;     ///< of the planning time, within validity
  std::uint64_t motions = 0, states = 0;
  PathJudgement path;  ///< of a solved problem
};

struct PlanningLimits {
  double seconds = 5.0;  ///< s, wall
  std::uint32_t seed = 1;
};

constexpr double kContactStep = 1e-3;  ///< rad

/// What a path's colliding segments are like, by samples.
class ContactSamples {
 public:
  ContactSamples(const Checker& checker, PathJudgement& judgement)
      : checker_(checker), workspace_(checker), judgement_(judgement) {}

  void segment(const std::vector<double>& from, const std::vector<double>& to) {
    double squared = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i) squared += (to[i] - from[i]) * (to[i] - from[i]);
    const double length = std::sqrt(squared);
    const int steps = std::max(1, static_cast<int>(std::ceil(length / kContactStep)));
    for (int k = 1; k <= steps; ++k) {
      const Eigen::VectorXd q = checker_.interpolate(from, to, static_cast<double>(k) / steps);
      state({q.data(), static_cast<std::size_t>(q.size())}, length / steps);
    }
  }
  /// What comes now does not follow on what came.
  void interrupt() { running_ = 0.0; }

 private:
  void state(std::span<const double> q, double step) {
    if (checker_.checkState(q, workspace_) != Verdict::Collision) return interrupt();
    running_ += step;
    judgement_.stretch = std::max(judgement_.stretch, running_);
    judgement_.depth = std::max(judgement_.depth, -checker_.signedClearance(q, workspace_).lower);
  }

  const Checker& checker_;
  Workspace workspace_;
  PathJudgement& judgement_;
  double running_ = 0.0;  ///< rad (L2), in contact until now
};

inline PathJudgement judge(const ompl::geometric::PathGeometric& path, const Checker& checker) {
  const StateConversion conversion(checker.robot(), checker.group());
  std::vector<double> from(static_cast<std::size_t>(checker.dimension())), to(from);
  PathJudgement judgement;
  ContactSamples contacts(checker, judgement);
  unsigned segment = 0;
  for (const MotionCertificate& certificate : certifyPath(path, checker)) {
    ++judgement.segments;
    conversion.toConfiguration(path.getState(segment), from);
    conversion.toConfiguration(path.getState(++segment), to);
    if (certificate.verdict == Verdict::Collision) {
      ++judgement.colliding;
      judgement.verdict = Verdict::Collision;
      contacts.segment(from, to);
      continue;
    }
    contacts.interrupt();
    if (certificate.verdict == Verdict::Undecided && judgement.verdict == Verdict::Free)
      judgement.verdict = Verdict::Undecided;
  }
  return judgement;
}

inline ompl::geometric::SimpleSetupPtr setupOf(const std::shared_ptr<const Checker>& checker,
                                               const Method& method) {
  if (!method.resolution) return makeSimpleSetup(checker);
  auto setup = std::make_shared<ompl::geometric::SimpleSetup>(
      makeStateSpace(checker->robot(), checker->group()));
  const ompl::base::SpaceInformationPtr& si = setup->getSpaceInformation();
  si->setStateValidityChecker(std::make_shared<FclStates>(si, *checker));
  si->setMotionValidator(std::make_shared<ompl::base::DiscreteMotionValidator>(si));
  si->setStateValidityCheckingResolution(*method.resolution);
  return setup;
}

/// RRTConnect with its default range from the start to the goal; made ready, not yet run.
inline void prepare(ompl::geometric::SimpleSetup& setup, const PlanningCase& problem,
                    const Checker& checker, const Method& method) {
  const StateConversion conversion(checker.robot(), checker.group());
  ompl::base::ScopedState<> start(setup.getStateSpace()), goal(setup.getStateSpace());
  conversion.toState(problem.start, start.get());
  conversion.toState(problem.goal, goal.get());
  setup.setStartAndGoalStates(start, goal);
  const auto planner = std::make_shared<ompl::geometric::RRTConnect>(setup.getSpaceInformation());
  setup.setPlanner(planner);
  setup.setup();
  // After OMPL's own have drawn their seeds: every method's samplers get the same ones.
  if (method.nearestStates) planner->setNearestNeighbors<NearestStates>();
}

/// What planning problems needs besides them.
class Planning {
 public:
  explicit Planning(const PlanningLimits& limits)
      : limits_(limits), meterSeconds_(benchmark::meterSeconds(clock_)) {}

  /// s of CPU time for each timed call; left out of what is reported.
  double meterSeconds() const { return meterSeconds_; }

  /// `number`: the problem's; it shifts the seed, the same for every method.
  Attempt attempt(const std::shared_ptr<const Checker>& checker, const PlanningCase& problem,
                  std::uint32_t number, const Method& method) const {
    // Spaces and planners draw from the seed as soon as they are made.
    ompl::RNG::setSeed(limits_.seed + number);
    Attempt attempt;
    const double begin = cpuSeconds();
    const ompl::geometric::SimpleSetupPtr setup = setupOf(checker, method);
    attempt.building = cpuSeconds() - begin;
    ValidityMeter meter(clock_);
    meterValidity(setup->getSpaceInformation(), meter);
    prepare(*setup, problem, *checker, method);
    solve(*setup, meter, attempt);
    if (attempt.solved) attempt.path = judge(setup->getSolutionPath(), *checker);
    return attempt;
  }

 private:
  void solve(ompl::geometric::SimpleSetup& setup, const ValidityMeter& meter,
             Attempt& attempt) const {
    ompl::base::PlannerStatus status;
    const double begin = cpuSeconds();
    // Given seconds, OMPL starts a thread for its clock, which takes half as long as a quick plan.
    const double wall = clock_.time([&] {
      status = setup.solve(ompl::base::timedPlannerTerminationCondition(limits_.seconds));
    });
    const double meters = meterSeconds_ * static_cast<double>(meter.timedCalls());
    attempt.seconds = cpuSeconds() - begin - meters;
    // One clock on both sides: what else the machine does falls on both alike.
    attempt.share = 1e-9 * meter.nanoseconds() / (1e-9 * wall - meters);
    attempt.solved = status == ompl::base::PlannerStatus::EXACT_SOLUTION;
    attempt.status = status.asString();
    attempt.motions = meter.motions();
    attempt.states = meter.states();
  }

  PlanningLimits limits_;
  BenchClock clock_;
  double meterSeconds_;
};

}  // namespace swept::benchmark
