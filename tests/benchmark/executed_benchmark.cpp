// SPDX-License-Identifier: BSD-3-Clause
// Planned paths as a controller executes them: proven blends, times and tubes, on
// MotionBenchMaker's problems; beside them what else is made of the same paths.
//   SWEPT_DATA=DATA executed_benchmark [panda] [ur5] [--sets N] [--seed N] [--tube E]
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <optional>

#include "arc_path.hpp"
#include "executed_samples.hpp"
#include "exit_code.hpp"
#include "number_argument.hpp"
#include "planning_problems.hpp"
#include "report/executed_curves.hpp"
#include "swept/ompl_bridge/paths.hpp"
#include "swept/ompl_bridge/setup.hpp"
#include "swept/robot_model/proven_trajectory.hpp"
#include "timing.hpp"

namespace swept::benchmark {
namespace {

using Path = std::vector<std::vector<double>>;

constexpr double kAcceleration = 3.0;  // rad/s^2, of every joint
constexpr double kPlanning = 5.0;      // s
constexpr double kSimplifying = 0.1;   // s
constexpr int kTurns = 5;              // of each time the least counts

struct Options {
  std::vector<std::string> robots;
  std::size_t perSet = kAllProblems;
  std::uint32_t seed = 1;
  double tube = 0.005;  // rad
};

/// CPU time of the least of several turns, s.
template <typename Work>
double least(const Work& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < kTurns; ++turn) {
    const double begin = cpuSeconds();
    work();
    best = std::min(best, cpuSeconds() - begin);
  }
  return best;
}

struct Verdicts {
  int free = 0, collision = 0, undecided = 0;

  void add(Verdict verdict) {
    free += verdict == Verdict::Free ? 1 : 0;
    collision += verdict == Verdict::Collision ? 1 : 0;
    undecided += verdict == Verdict::Undecided ? 1 : 0;
  }
  int all() const { return free + collision + undecided; }
};

std::string share(int part, int all) {
  return number(100.0 * part / std::max(1, all)) + " %";
}

/// Mean, 95 % and largest.
std::string spread(std::vector<double> values) {
  if (values.empty()) return "-";
  std::ranges::sort(values);
  double sum = 0.0;
  for (const double value : values) sum += value;
  const auto count = static_cast<double>(values.size());
  const auto at = static_cast<std::size_t>(0.95 * (count - 1.0));
  return number(sum / count) + " / " + number(values[at]) + " / " + number(values.back());
}

/// What is made of paths that were checked as polylines.
struct OtherCurves {
  std::array<Verdicts, 3> arcs;
  Verdicts spline;
};
constexpr std::array kDeviations{0.1, 0.05, 0.01};  // rad

class RobotPaths {
 public:
  RobotPaths(const Options& options, const std::string& name, const PlanningProblems& problems)
      : options_(options),
        name_(name),
        robot_(*problems.robot()),
        group_(*robot_.findGroup(problems.group())),
        limits_(RateLimits::of(robot_, group_)),
        empty_(problems.robot(), problems.group(), std::make_shared<const World>()),
        emptyInTube_(empty_.withTracking({{.rotation = options.tube, .translation = 0.0}, {}})) {
    limits_.acceleration.assign(limits_.velocity.size(), kAcceleration);
    for (const PlanningCase& problem : problems.cases()) {
      solve(problem);
      if (++seen_ % 50 == 0)
        std::cerr << name << ": " << seen_ << " of " << problems.cases().size() << '\n';
    }
  }

  bool holds() const { return proven_.collision == 0 && hits_ == 0 && seen_ > 0; }

  void printProofs(const MarkdownTable& table) const {
    table.row({name_, std::to_string(seen_), std::to_string(noRoom_), std::to_string(unsolved_),
               std::to_string(proven_.all()), std::to_string(proven_.free),
               number(static_cast<double>(states_), 4), std::to_string(hits_),
               std::to_string(blends_), std::to_string(stops_)});
  }
  void printTimes(const MarkdownTable& table) const {
    table.row({name_, spread(toArcs_), spread(toStops_), number(1e6 * timing_ / proven_.all()),
               number(1e3 * proving_ / proven_.all()), number(curve_ / polyline_),
               number(curveInTube_ / polyline_), number(curveInTube_ / polylineInTube_)});
  }
  void printOthers(const MarkdownTable& table) const {
    printOthers(table, "in the tube", inTube_);
    printOthers(table, "without it", plain_);
  }

 private:
  void printOthers(const MarkdownTable& table, const char* planned, const OtherCurves& of) const {
    std::vector<std::string> cells{name_, planned, std::to_string(of.spline.all())};
    for (const Verdicts& own : of.arcs)
      cells.push_back(share(own.collision, own.all()) + " (" + share(own.undecided, own.all()) +
                      ")");
    cells.push_back(share(of.spline.collision, of.spline.all()) + " (" +
                    share(of.spline.undecided, of.spline.all()) + ")");
    table.row(cells);
  }

  /// No value: there is none, or none within the time.
  static std::optional<Path> plan(const std::shared_ptr<const Checker>& checker,
                                  const PlanningCase& problem) {
    const auto setup = makeSimpleSetup(checker);
    setStartAndGoal(*setup, *checker, problem.start, problem.goal);
    setup->setPlanner(std::make_shared<ompl::geometric::RRTConnect>(setup->getSpaceInformation()));
    if (setup->solve(kPlanning) != ompl::base::PlannerStatus::EXACT_SOLUTION) return std::nullopt;
    simplifyPath(setup->getSolutionPath(), *checker, kSimplifying, setup->getGoal());
    return configurationsOf(setup->getSolutionPath(), *checker);
  }

  void solve(const PlanningCase& problem) {
    const auto plain = std::make_shared<const Checker>(empty_.withWorld(problem.world));
    const auto inTube = std::make_shared<const Checker>(emptyInTube_.withWorld(problem.world));
    if (const auto path = plan(plain, problem)) addOthers(*plain, *path, plain_);
    Workspace workspace(*inTube);
    if (inTube->checkState(problem.start, workspace) != Verdict::Free ||
        inTube->checkState(problem.goal, workspace) != Verdict::Free) {
      ++noRoom_;
      return;
    }
    if (const auto path = plan(inTube, problem)) {
      addOthers(*plain, *path, inTube_);
      prove(*plain, *inTube, *path);
    } else {
      ++unsolved_;
    }
  }

  static void addOthers(const Checker& plain, const Path& path, OtherCurves& of) {
    Workspace workspace(plain);
    const Eigen::MatrixXd points = continuousWayPoints(plain.robot(), plain.group(), path);
    const auto verdictOf = [&](const PiecewisePolynomial& curve) {
      return plain.certifyTrajectory(curve, workspace, {.contact = MotionQuery::VerdictOnly})
          .verdict;
    };
    for (std::size_t i = 0; i < kDeviations.size(); ++i)
      of.arcs[i].add(verdictOf(circularBlends(points, kDeviations[i])));
    of.spline.add(verdictOf(cubicSpline(points)));
  }

  void prove(const Checker& plain, const Checker& inTube, const Path& path) {
    const double begin = cpuSeconds();
    const ProvenTrajectory found = provenTrajectory(inTube, path, limits_);
    proving_ += cpuSeconds() - begin;
    proven_.add(found.certificate.verdict);
    for (const TimedCorner& corner : found.timed.corners) ++(corner.stops() ? stops_ : blends_);
    ExecutedSamples samples(plain, options_.tube,
                            options_.seed + static_cast<std::uint32_t>(seen_));
    samples.add(found.timed.trajectory);
    states_ += samples.states();
    hits_ += samples.hits();

    TimingOptions stopping;
    stopping.blendDeviation = 0.0;
    const double stops =
        timeParameterize(robot_, group_, path, limits_, {}, stopping).curve.duration();
    toStops_.push_back(found.timed.curve.duration() / stops);
    double blended = 0.0;
    timing_ +=
        least([&] { blended = timeParameterize(robot_, group_, path, limits_).curve.duration(); });
    const LeastDuration arcs(arcPath(path, TimingOptions{}.blendDeviation), limits_.velocity,
                             limits_.acceleration);
    toArcs_.push_back(blended / arcs.seconds());
    compare(plain, found.timed.curve, path, curve_, polyline_);
    compare(inTube, found.timed.curve, path, curveInTube_, polylineInTube_);
  }

  static void compare(const Checker& checker, const PiecewisePolynomial& curve, const Path& path,
                      double& ofCurve, double& ofPolyline) {
    Workspace workspace(checker);
    ofCurve += least([&] {
      checker.certifyTrajectory(curve, workspace, {.contact = MotionQuery::VerdictOnly});
    });
    ofPolyline += least([&] {
      for (std::size_t i = 0; i + 1 < path.size(); ++i)
        checker.certifyMotion(path[i], path[i + 1], workspace, MotionQuery::VerdictOnly);
    });
  }

  const Options& options_;
  const std::string name_;
  const Robot& robot_;
  const Group& group_;
  RateLimits limits_;
  const Checker empty_, emptyInTube_;
  int seen_ = 0, noRoom_ = 0, unsolved_ = 0, blends_ = 0, stops_ = 0;
  Verdicts proven_;
  OtherCurves inTube_, plain_;
  std::int64_t states_ = 0, hits_ = 0;
  std::vector<double> toArcs_, toStops_;  ///< ratios of durations
  double timing_ = 0.0, proving_ = 0.0;   ///< s, of all
  double curve_ = 0.0, polyline_ = 0.0;   ///< s, of all
  double curveInTube_ = 0.0, polylineInTube_ = 0.0;
};

/// Random paths of ten way points: what timing them costs, and how long they take.
class RandomPaths {
 public:
  explicit RandomPaths(std::uint32_t seed) : random_(seed) {}

  void print(const Robot& robot, const Group& group, const std::string& name,
             const MarkdownTable& table) {
    RateLimits limits = RateLimits::of(robot, group);
    limits.acceleration.assign(limits.velocity.size(), kAcceleration);
    limits.jerk.assign(limits.velocity.size(), 10.0 * kAcceleration);
    for (const double step : {0.3, 1.0}) {
      for (const bool jerkLimited : {false, true}) {
        TimingOptions options;
        options.jerkLimited = jerkLimited;
        std::vector<double> ratios, times;
        for (int i = 0; i < 200; ++i) {
          const Path path = draw(limits.velocity.size(), step);
          double duration = 0.0;
          times.push_back(
              1e3 * least([&] {
                duration =
                    timeParameterize(robot, group, path, limits, {}, options).curve.duration();
              }));
          const LeastDuration arcs(arcPath(path, options.blendDeviation), limits.velocity,
                                   limits.acceleration);
          ratios.push_back(duration / arcs.seconds());
        }
        table.row({name, number(step), jerkLimited ? "yes" : "no", spread(ratios), spread(times)});
      }
    }
  }

 private:
  /// Steps of a normal distribution, `step` rad of each joint.
  Path draw(std::size_t joints, double step) {
    std::normal_distribution<double> normal(0.0, step);
    Path path{std::vector<double>(joints, 0.0)};
    while (path.size() < 10) {
      std::vector<double> next = path.back();
      for (double& value : next) value += normal(random_);
      path.push_back(next);
    }
    return path;
  }

  std::mt19937 random_;
};

/// False when a trajectory is in contact, by its own proof or by samples.
bool run(const Options& options, const std::filesystem::path& data) {
  std::vector<RobotPaths> robots;
  RandomPaths random(options.seed);
  robots.reserve(options.robots.size());
  std::printf(
      "Timing of 200 random paths of 10 way points; ratios and ms: mean / 95 %% / largest\n\n");
  const MarkdownTable timing({"robot", "step rad", "jerks limited", "duration / arcs", "ms"});
  bool holds = true;
  for (const std::string& name : options.robots) {
    const PlanningProblems problems(data, name, options.perSet);
    random.print(*problems.robot(), *problems.robot()->findGroup(problems.group()), name, timing);
    robots.emplace_back(options, name, problems);
    holds = robots.back().holds() && holds;
  }
  std::printf("\nPlanned, blended and timed in a tube of %s rad per joint (seed %u)\n\n",
              number(options.tube).c_str(), options.seed);
  const MarkdownTable proofs({"robot", "problems", "no room for the tube at an end", "not solved",
                              "trajectories", "proven", "states sampled", "in collision", "blends",
                              "stops"});
  for (const RobotPaths& robot : robots) robot.printProofs(proofs);
  std::printf("\nTheir times; ratios of durations: mean / 95 %% / largest\n\n");
  const MarkdownTable times({"robot", "duration / arcs", "duration / stopping", "timing us",
                             "with all proofs ms", "certify curve / polyline",
                             "curve in the tube / polyline", "both in the tube"});
  for (const RobotPaths& robot : robots) robot.printTimes(times);
  std::printf("\nWhat else is executed of the paths: in collision (undecided)\n\n");
  const MarkdownTable others(
      {"robot", "planned", "paths", "arcs, 0.1 rad", "0.05 rad", "0.01 rad", "C2 spline"});
  for (const RobotPaths& robot : robots) robot.printOthers(others);
  return holds;
}

bool takeOption(const std::string& name, const std::string& text, Options& options) {
  const std::optional<double> value = positiveNumber(text);
  if (!value) return false;
  if (name == "--tube") {
    options.tube = *value;
    return true;
  }
  if (*value != std::floor(*value) || *value > 1e9) return false;
  if (name == "--sets") options.perSet = static_cast<std::size_t>(*value);
  if (name == "--seed") options.seed = static_cast<std::uint32_t>(*value);
  return name == "--sets" || name == "--seed";
}

std::optional<Options> optionsOf(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "panda") {
      options.robots.emplace_back("Panda");
    } else if (word == "ur5") {
      options.robots.emplace_back("UR5");
    } else {
      if (i + 1 == argc || !takeOption(word, argv[i + 1], options)) return std::nullopt;
      ++i;
    }
  }
  if (options.robots.empty()) options.robots = {"Panda", "UR5"};
  return options;
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  return swept::benchmark::exitCodeWithData(
      swept::benchmark::optionsOf(argc, argv),
      "executed_benchmark [panda] [ur5] [--sets N] [--seed N] [--tube E]",
      [](const auto& options, const auto& data) {
        ompl::msg::noOutputHandler();
        ompl::RNG::setSeed(options.seed);
        return swept::benchmark::run(options, data);
      });
}
