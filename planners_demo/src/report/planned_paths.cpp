// SPDX-License-Identifier: BSD-3-Clause
#include "report/planned_paths.hpp"

#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <optional>

#include "report/executed_curves.hpp"
#include "report/random_motions.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

constexpr std::size_t kPairsPerPath = 100;  // of states, until one needs a corner
constexpr unsigned kIterations = 3000;      // of the planner
constexpr double kSimplifyTime = 60.0;      // s; it ends by itself, long before

/// None: the planner found none, or it has no corner.
std::optional<Eigen::MatrixXd> plannedPath(const std::shared_ptr<const Checker>& checker,
                                           const std::vector<double>& from,
                                           const std::vector<double>& to) {
  const og::SimpleSetupPtr setup = makeSimpleSetup(checker);
  setStartAndGoal(*setup, *checker, from, to);
  setup->setPlanner(std::make_shared<og::RRTConnect>(setup->getSpaceInformation()));
  ob::IterationTerminationCondition iterations(kIterations);
  if (setup->solve(iterations) != ob::PlannerStatus::EXACT_SOLUTION) return std::nullopt;
  og::PathGeometric& path = setup->getSolutionPath();
  const std::vector<MotionCertificate> motions = simplifyPath(path, *checker, kSimplifyTime);
  const bool proven = std::ranges::all_of(
      motions, [](const MotionCertificate& motion) { return motion.verdict == Verdict::Free; });
  if (!proven || path.getStateCount() < 3) return std::nullopt;
  return continuousWayPoints(checker->robot(), checker->group(), configurationsOf(path, *checker));
}

}  // namespace

std::vector<Eigen::MatrixXd> plannedPaths(const ReportWorld& world,
                                          const std::shared_ptr<const Checker>& checker,
                                          std::size_t count, std::uint32_t seed,
                                          const ReportTick& tick) {
  ompl::RNG::setSeed(seed);
  RandomMotions random(world, *checker);
  Workspace workspace(*checker);
  std::vector<Eigen::MatrixXd> paths;
  std::size_t failures = 0;
  for (std::size_t i = 0; i < kPairsPerPath * count && paths.size() < count; ++i) {
    tick(0);
    const std::vector<double> from = random.freeState(), to = random.freeState();
    if (checker->certifyMotion(from, to, workspace, MotionQuery::VerdictOnly).verdict ==
        Verdict::Free)
      continue;
    if (const std::optional<Eigen::MatrixXd> path = plannedPath(checker, from, to))
      paths.push_back(*path);
    else if (++failures > count)
      break;
  }
  return paths;
}

}  // namespace swept
