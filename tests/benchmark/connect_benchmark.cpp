// SPDX-License-Identifier: BSD-3-Clause
// A plan from end to end: CertifiedConnect and shortenPath beside OMPL's RRTConnect and
// simplifier, on MotionBenchMaker's problems; and beside another program's times of the same.
//   SWEPT_DATA=DATA connect_benchmark [panda] [ur5] [--sets N] [--seed N] [--turns N]
//                                     [--peer FILE.csv]
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "exit_code.hpp"
#include "number_argument.hpp"
#include "planning_problems.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "timing.hpp"

namespace swept::benchmark {
namespace {

constexpr double kPlanning = 5.0;  // s

struct Options {
  std::vector<std::string> robots;
  std::size_t perSet = kAllProblems;
  std::uint32_t seed = 1;
  int turns = 5;     ///< of each time the least counts
  std::string peer;  ///< a file of another program's times; empty: none
};

/// Median, mean and 95 %.
std::string spread(std::vector<double> values) {
  if (values.empty()) return "-";
  std::ranges::sort(values);
  double sum = 0.0;
  for (const double value : values) sum += value;
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return number(at(0.5)) + " / " + number(sum / static_cast<double>(values.size())) + " / " +
         number(at(0.95));
}

/// What one way to plan gave on all problems of a robot; us.
struct Times {
  explicit Times(std::string named) : name(std::move(named)) {}

  std::string name;
  std::vector<double> plan, shorten, both, all, length;
  std::size_t segments = 0, undecided = 0;
  double motions = 0.0;

  void print(const MarkdownTable& table, const std::string& robot) const {
    const auto count = static_cast<double>(std::max<std::size_t>(plan.size(), 1));
    table.row({robot, name, std::to_string(plan.size()), number(motions / count), spread(plan),
               spread(shorten), spread(both), spread(all), spread(length),
               number(static_cast<double>(segments) / count), std::to_string(undecided)});
  }
};

/// A planner and a simplifier.
struct Way {
  std::string name;
  ompl::base::PlannerPtr (*planner)(const ompl::geometric::SimpleSetup& setup, std::uint32_t seed);
  void (*shorten)(ompl::geometric::PathGeometric& path);
};

ompl::base::PlannerPtr certifiedConnect(const ompl::geometric::SimpleSetup& setup,
                                        std::uint32_t seed) {
  const auto planner = std::make_shared<CertifiedConnect>(setup.getSpaceInformation());
  planner->setSeed(seed);
  return planner;
}

ompl::base::PlannerPtr rrtConnect(const ompl::geometric::SimpleSetup& setup, std::uint32_t) {
  const auto planner = std::make_shared<ompl::geometric::RRTConnect>(setup.getSpaceInformation());
  useNearestStates(*planner);
  return planner;
}

const std::vector<Way> kWays{
    {"CertifiedConnect, shortenPath", certifiedConnect,
     [](ompl::geometric::PathGeometric& path) { shortenPath(path); }},
    {"OMPL's RRTConnect, simplifyMax", rrtConnect, [](ompl::geometric::PathGeometric& path) {
       ompl::geometric::PathSimplifier(path.getSpaceInformation()).simplifyMax(path);
     }}};

class RobotPlans {
 public:
  RobotPlans(const Options& options, const PlanningProblems& problems) : options_(options) {
    const Checker empty(problems.robot(), problems.group(), std::make_shared<const World>());
    for (const Way& way : kWays) times_.emplace_back(way.name);
    std::size_t seen = 0;
    for (const PlanningCase& problem : problems.cases()) {
      const auto checker = std::make_shared<const Checker>(empty.withWorld(problem.world));
      for (std::size_t i = 0; i < kWays.size(); ++i) plan(checker, problem, kWays[i], times_[i]);
      if (++seen % 100 == 0)
        std::cerr << seen << " of " << problems.cases().size() << " problems\n";
    }
  }

  const std::vector<Times>& times() const { return times_; }

 private:
  void plan(const std::shared_ptr<const Checker>& checker, const PlanningCase& problem,
            const Way& way, Times& times) const {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    constexpr double kMicro = 1e6;
    double planning = kNever, shortening = kNever, both = kNever, all = kNever;
    for (int turn = 0; turn < options_.turns; ++turn) {
      ompl::RNG::setSeed(options_.seed);
      const double begin = cpuSeconds();
      const auto setup = makeSimpleSetup(checker);
      setStartAndGoal(*setup, *checker, problem.start, problem.goal);
      setup->setPlanner(way.planner(*setup, options_.seed));
      setup->setup();
      const double ready = cpuSeconds();
      if (setup->solve(kPlanning) != ompl::base::PlannerStatus::EXACT_SOLUTION) return;
      ompl::geometric::PathGeometric& path = setup->getSolutionPath();
      const double planned = cpuSeconds();
      way.shorten(path);
      const double done = cpuSeconds();
      planning = std::min(planning, planned - ready);
      shortening = std::min(shortening, done - planned);
      both = std::min(both, done - ready);
      all = std::min(all, done - begin);
      if (turn > 0) continue;
      times.length.push_back(path.length());
      times.motions += setup->getSpaceInformation()->getMotionValidator()->getCheckedMotionCount();
      for (const MotionCertificate& certificate : certifyPath(path, *checker)) {
        ++times.segments;
        times.undecided += certificate.verdict != Verdict::Free ? 1 : 0;
      }
    }
    times.plan.push_back(kMicro * planning);
    times.shorten.push_back(kMicro * shortening);
    times.both.push_back(kMicro * both);
    times.all.push_back(kMicro * all);
  }

  Options options_;
  std::vector<Times> times_;
};

/// Columns plan_us, simplify_us and simplified_length of a file with a header; problems whose
/// length is 0 are not solved. Throws std::runtime_error for another file.
Times readPeer(const std::string& file) {
  std::ifstream in(file);
  std::string line, cell;
  std::map<std::string, std::size_t> columns;
  std::getline(in, line);
  for (std::istringstream head(line); std::getline(head, cell, ',');)
    columns.emplace(cell, columns.size());
  for (const char* name : {"plan_us", "simplify_us", "simplified_length"})
    if (!columns.contains(name)) throw std::runtime_error(file + ": no column " + name);
  Times times("peer");
  while (std::getline(in, line)) {
    std::vector<std::string> cells;
    for (std::istringstream row(line); std::getline(row, cell, ',');) cells.push_back(cell);
    const auto value = [&](const char* name) { return std::stod(cells.at(columns.at(name))); };
    if (value("simplified_length") == 0.0) continue;
    times.plan.push_back(value("plan_us"));
    times.shorten.push_back(value("simplify_us"));
    times.both.push_back(times.plan.back() + times.shorten.back());
    times.length.push_back(value("simplified_length"));
  }
  return times;
}

/// False when a segment of a path of ours is not proven free.
bool run(const Options& options, const std::filesystem::path& data) {
  std::printf("us of CPU time and lengths in rad: median / mean / 95 %% (seed %u)\n\n",
              options.seed);
  const MarkdownTable table({"robot", "way", "solved", "motions", "plan", "shorten", "both",
                             "with set-up", "length", "segments", "not proven"});
  bool proven = true;
  for (const std::string& name : options.robots) {
    const PlanningProblems problems(data, name, options.perSet);
    const RobotPlans plans(options, problems);
    for (const Times& times : plans.times()) {
      times.print(table, name);
      proven = proven && times.undecided == 0;
    }
    if (!options.peer.empty()) readPeer(options.peer).print(table, name);
  }
  return proven;
}

bool takeOption(const std::string& name, const std::string& text, Options& options) {
  if (name == "--peer") {
    options.peer = text;
    return true;
  }
  const std::optional<double> value = positiveNumber(text);
  if (!value || *value != std::floor(*value) || *value > 1e9) return false;
  if (name == "--sets") options.perSet = static_cast<std::size_t>(*value);
  if (name == "--seed") options.seed = static_cast<std::uint32_t>(*value);
  if (name == "--turns") options.turns = static_cast<int>(*value);
  return name == "--sets" || name == "--seed" || name == "--turns";
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
  if (!options.peer.empty() && options.robots.size() > 1) return std::nullopt;
  return options;
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  return swept::benchmark::exitCodeWithData(
      swept::benchmark::optionsOf(argc, argv),
      "connect_benchmark [panda] [ur5] [--sets N] [--seed N] [--turns N] [--peer FILE.csv, with "
      "one robot]",
      [](const auto& options, const auto& data) {
        ompl::msg::noOutputHandler();
        return swept::benchmark::run(options, data);
      });
}
