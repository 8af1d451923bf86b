// SPDX-License-Identifier: BSD-3-Clause
// Plans that keep an axis of the hand within an angle of a direction: CertifiedConnect and
// shortenPath beside OMPL's RRTConnect in its ProjectedStateSpace and AtlasStateSpace, with our
// validator (makeConstrainedSetup), and with OMPL's over FCL where it is installed, else over our
// own states. The axis is the one that has the same direction
// at both ends of a problem of MotionBenchMaker: that of the rotation between them.
//   SWEPT_DATA=DATA constrained_benchmark [--sets N] [--seed N] [--degrees D]... [--seconds S]
#include <ompl/base/ConstrainedSpaceInformation.h>
#include <ompl/base/spaces/constraint/AtlasStateSpace.h>
#include <ompl/base/spaces/constraint/ProjectedStateSpace.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "exit_code.hpp"
#include "number_argument.hpp"
#include "planning_problems.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/robot_model/constraint_projection.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"
#include "timing.hpp"
#ifdef SWEPT_HAS_FCL
#include "bench/fcl_robot.hpp"
#endif

namespace swept::benchmark {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

struct Options {
  std::size_t perSet = kAllProblems;
  std::uint32_t seed = 1;
  std::vector<double> degrees;
  double seconds = 5.0;
};

/// What one way to plan gave at one tolerance.
struct Outcome {
  std::string name;
  std::size_t asked = 0, solved = 0, proven = 0, leaving = 0, colliding = 0;
  std::vector<double> plan, shorten, length;  ///< s, s, rad; of a problem without a path the limit
};

double medianOf(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

double quantileOf(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// The tilt of the hand's axis as a user of OMPL gives it: two values, each a share of the
/// tolerance, with their exact derivatives.
class TiltManifold : public ob::Constraint {
 public:
  TiltManifold(const Checker& checker, double tolerance)
      : Constraint(static_cast<unsigned>(checker.dimension()),
                   static_cast<unsigned>(ConstraintProjection(checker).rows()), tolerance),
        projection_(checker),
        workspace_(projection_) {}
  void function(const Eigen::Ref<const Eigen::VectorXd>& x,
                Eigen::Ref<Eigen::VectorXd> out) const override {
    projection_.residuals({x.data(), static_cast<std::size_t>(x.size())}, out, workspace_);
  }
  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& x,
                Eigen::Ref<Eigen::MatrixXd> out) const override {
    projection_.jacobian({x.data(), static_cast<std::size_t>(x.size())}, out, workspace_);
  }

 private:
  ConstraintProjection projection_;
  mutable ConstraintProjection::Workspace workspace_;  // OMPL's interface is const
};

/// States of a constrained space that are free.
class FreeStates : public ob::StateValidityChecker {
 public:
  FreeStates(const ob::SpaceInformationPtr& si, const Checker& checker)
      : StateValidityChecker(si),
        checker_(checker),
        workspace_(checker)
#ifdef SWEPT_HAS_FCL
        ,
        fcl_(std::make_unique<FclRobot>(checker))
#endif
  {
  }
  bool isValid(const ob::State* state) const override {
    const auto& x = *state->as<ob::ConstrainedStateSpace::StateType>();
    if (!si_->satisfiesBounds(state)) return false;
    const std::vector<double> q(x.data(), x.data() + x.size());
#ifdef SWEPT_HAS_FCL
    return !fcl_->collides(q);
#else
    return checker_.checkState(q, workspace_) == Verdict::Free;
#endif
  }

 private:
  const Checker& checker_;
  mutable Workspace workspace_;
#ifdef SWEPT_HAS_FCL
  std::unique_ptr<FclRobot> fcl_;
#endif
};

/// A problem at one tolerance.
struct Task {
  const PlanningCase& problem;
  std::shared_ptr<const Checker> free;  ///< without the constraint
  std::shared_ptr<const Checker> kept;  ///< with it
};

bool isProven(const std::vector<std::vector<double>>& path, const Checker& checker) {
  Workspace workspace(checker);
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    if (checker.certifyMotion(path[i], path[i + 1], workspace).verdict != Verdict::Free)
      return false;
  return true;
}

void planOurs(const Task& task, const Options& options, Outcome& outcome) {
  ompl::RNG::setSeed(options.seed);
  const auto setup = makeSimpleSetup(task.kept);
  setStartAndGoal(*setup, *task.kept, task.problem.start, task.problem.goal);
  const auto planner = std::make_shared<CertifiedConnect>(setup->getSpaceInformation());
  planner->setSeed(options.seed);
  setup->setPlanner(planner);
  setup->setup();
  ++outcome.asked;
  const double begin = cpuSeconds();
  const bool solved = setup->solve(options.seconds) == ob::PlannerStatus::EXACT_SOLUTION;
  outcome.plan.push_back(solved ? cpuSeconds() - begin : options.seconds);
  if (!solved) return;
  ++outcome.solved;
  const double planned = cpuSeconds();
  shortenPath(setup->getSolutionPath());
  outcome.shorten.push_back(cpuSeconds() - planned);
  outcome.length.push_back(setup->getSolutionPath().length());
  outcome.proven += isProven(configurationsOf(setup->getSolutionPath(), *task.kept), *task.kept);
}

/// OMPL's planner and space, with motions that CertifiedGeodesicValidator proves.
void planProven(const Task& task, const Options& options, ConstrainedSpace space,
                Outcome& outcome) {
  ompl::RNG::setSeed(options.seed);
  const auto setup = makeConstrainedSetup(task.kept, space);
  setConstrainedStartAndGoal(*setup, task.problem.start, task.problem.goal);
  setup->setPlanner(std::make_shared<og::RRTConnect>(setup->getSpaceInformation()));
  setup->setup();
  ++outcome.asked;
  const double begin = cpuSeconds();
  const bool solved = setup->solve(options.seconds) == ob::PlannerStatus::EXACT_SOLUTION;
  outcome.plan.push_back(solved ? cpuSeconds() - begin : options.seconds);
  if (!solved) return;
  ++outcome.solved;
  const double planned = cpuSeconds();
  setup->simplifySolution();
  outcome.shorten.push_back(cpuSeconds() - planned);
  outcome.length.push_back(setup->getSolutionPath().length());
  const std::vector<std::vector<double>> executed = provenWayPoints(setup->getSolutionPath());
  outcome.proven += !executed.empty() && isProven(executed, *task.kept) ? 1 : 0;
}

/// What the exact checkers say of the path that OMPL would execute: its states every `delta`.
void judge(const std::vector<std::vector<double>>& path, const Task& task, Outcome& outcome) {
  Workspace workspace(*task.free), keeping(*task.kept);
  bool leaves = false, collides = false, proven = true;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const MotionCertificate kept = task.kept->certifyMotion(path[i], path[i + 1], keeping);
    const MotionCertificate free = task.free->certifyMotion(path[i], path[i + 1], workspace);
    leaves = leaves || kept.violation.has_value();
    collides = collides || free.verdict == Verdict::Collision;
    proven = proven && kept.verdict == Verdict::Free;
  }
  outcome.leaving += leaves ? 1 : 0;
  outcome.colliding += collides ? 1 : 0;
  outcome.proven += proven ? 1 : 0;
}

template <typename Space>
void planTheirs(const Task& task, const Options& options, double tolerance, Outcome& outcome) {
  ompl::RNG::setSeed(options.seed);
  const auto ambient = makeStateSpace(task.kept->robot(), task.kept->group());
  const auto manifold = std::make_shared<TiltManifold>(*task.kept, tolerance);
  const auto space = std::make_shared<Space>(ambient, manifold);
  const auto si = std::make_shared<ob::ConstrainedSpaceInformation>(space);
  og::SimpleSetup setup(si);
  setup.setStateValidityChecker(std::make_shared<FreeStates>(si, *task.free));
  ob::ScopedState<> start(space), goal(space);
  const auto put = [](const std::vector<double>& q, ob::ScopedState<>& state) {
    state->as<ob::ConstrainedStateSpace::StateType>()->copy(
        Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size())));
  };
  put(task.problem.start, start);
  put(task.problem.goal, goal);
  setup.setStartAndGoalStates(start, goal);
  setup.setPlanner(std::make_shared<og::RRTConnect>(si));
  setup.setup();
  if constexpr (std::is_base_of_v<ob::AtlasStateSpace, Space>) {
    space->anchorChart(start.get());
    space->anchorChart(goal.get());
  }
  ++outcome.asked;
  const double begin = cpuSeconds();
  const bool solved = setup.solve(ob::timedPlannerTerminationCondition(options.seconds)) ==
                      ob::PlannerStatus::EXACT_SOLUTION;
  outcome.plan.push_back(solved ? cpuSeconds() - begin : options.seconds);
  if (!solved) return;
  ++outcome.solved;
  const double planned = cpuSeconds();
  setup.simplifySolution();
  outcome.shorten.push_back(cpuSeconds() - planned);
  og::PathGeometric& path = setup.getSolutionPath();
  outcome.length.push_back(path.length());
  path.interpolate();
  std::vector<std::vector<double>> states;
  for (const ob::State* state : path.getStates()) {
    const auto& x = *state->as<ob::ConstrainedStateSpace::StateType>();
    states.emplace_back(x.data(), x.data() + x.size());
  }
  judge(states, task, outcome);
}

/// The constraint of a problem.
TaskConstraint constraintOf(const InverseKinematics& hand, const PlanningCase& problem,
                            const std::string& link, double angle) {
  const Eigen::Matrix3d start = hand.pose(problem.start).linear();
  const Eigen::Matrix3d goal = hand.pose(problem.goal).linear();
  AxisConstraint own;
  own.frame.body = link;
  own.axis = Eigen::AngleAxisd(goal.transpose() * start).axis();
  own.direction = start * own.axis;
  own.angle = angle;
  return {.axes = {own}};
}

void print(const MarkdownTable& table, double degrees, const Outcome& outcome) {
  constexpr double kMilli = 1e3;
  const auto part = [](std::size_t count, std::size_t of) {
    return std::to_string(count) + "/" + std::to_string(of);
  };
  table.row({number(degrees), outcome.name, part(outcome.solved, outcome.asked),
             number(kMilli * medianOf(outcome.plan)),
             number(kMilli * quantileOf(outcome.plan, 0.95)),
             number(kMilli * medianOf(outcome.shorten)), number(medianOf(outcome.length)),
             part(outcome.proven, outcome.solved), std::to_string(outcome.leaving),
             std::to_string(outcome.colliding)});
}

/// False when a path of ours is not proven.
bool run(const Options& options, const std::filesystem::path& data) {
  const PlanningProblems problems(data, "Panda", options.perSet);
  const std::string link = "panda_hand";
  const InverseKinematics hand(problems.robot(), problems.group(), link);
  const Checker empty(problems.robot(), problems.group(), std::make_shared<const World>());
  std::printf("ms of CPU time, %zu problems, %g s each (seed %u)\n\n", problems.cases().size(),
              options.seconds, options.seed);
  const MarkdownTable table({"degrees", "way", "solved", "plan, median", "95 %", "shorten, median",
                             "length, rad", "proven", "leave the tolerance", "collide"});
  bool proven = true;
  for (const double degrees : options.degrees) {
    Outcome ours{.name = "CertifiedConnect, shortenPath"};
    Outcome projected{.name = "OMPL, ProjectedStateSpace"}, atlas{.name = "OMPL, AtlasStateSpace"};
    Outcome provenProjected{.name = "the first, our validator"};
    Outcome provenAtlas{.name = "the second, our validator"};
    for (const PlanningCase& problem : problems.cases()) {
      const auto free = std::make_shared<const Checker>(empty.withWorld(problem.world));
      const auto kept = std::make_shared<const Checker>(free->withConstraints(
          constraintOf(hand, problem, link, degrees * std::numbers::pi / 180.0)));
      const Task task{problem, free, kept};
      planOurs(task, options, ours);
      planTheirs<ob::ProjectedStateSpace>(task, options, 1.0, projected);
      planTheirs<ob::AtlasStateSpace>(task, options, 1.0, atlas);
      planProven(task, options, ConstrainedSpace::Projected, provenProjected);
      planProven(task, options, ConstrainedSpace::Atlas, provenAtlas);
      if (ours.asked % 20 == 0)
        std::cerr << degrees << ": " << ours.asked << " of " << problems.cases().size() << "\n";
    }
    for (const Outcome& outcome : {ours, projected, atlas, provenProjected, provenAtlas})
      print(table, degrees, outcome);
    std::fflush(stdout);
    proven = proven && ours.proven == ours.solved;
  }
  return proven;
}

bool takeOption(const std::string& name, const std::string& text, Options& options) {
  const std::optional<double> value = positiveNumber(text);
  if (!value) return false;
  if (name == "--degrees") {
    options.degrees.push_back(*value);
    return true;
  }
  if (name == "--seconds") {
    options.seconds = *value;
    return true;
  }
  if (*value != std::floor(*value) || *value > 1e9) return false;
  if (name == "--sets") options.perSet = static_cast<std::size_t>(*value);
  if (name == "--seed") options.seed = static_cast<std::uint32_t>(*value);
  return name == "--sets" || name == "--seed";
}

std::optional<Options> optionsOf(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2)
    if (!takeOption(argv[i], argv[i + 1], options)) return std::nullopt;
  if (argc % 2 == 0) return std::nullopt;
  if (options.degrees.empty()) options.degrees = {10.0, 5.0, 1.0};
  return options;
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  return swept::benchmark::exitCodeWithData(
      swept::benchmark::optionsOf(argc, argv),
      "constrained_benchmark [--sets N] [--seed N] [--degrees D]... [--seconds S]",
      [](const auto& options, const auto& data) {
        ompl::msg::noOutputHandler();
        return swept::benchmark::run(options, data);
      });
}
