// SPDX-License-Identifier: BSD-3-Clause
// What planning costs, and what its paths are worth: swept against FCL under OMPL's discrete
// validator, on MotionBenchMaker's problems.
//   SWEPT_DATA=DATA planning_benchmark [panda] [ur5] [--sets N|all] [--time S] [--seed N]
//                                      [--overhead|--neighbours]
#include <ompl/util/Console.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <optional>

#include "exit_code.hpp"
#include "number_argument.hpp"
#include "planning_neighbours.hpp"
#include "planning_overhead.hpp"
#include "planning_tables.hpp"

namespace swept::benchmark {
namespace {

struct Options {
  std::vector<std::string> robots;
  std::size_t perSet = kAllProblems;
  PlanningLimits limits;
  bool overhead = false;    ///< measure the bridge alone, instead of planning
  bool neighbours = false;  ///< measure nearest neighbours alone
};

class PlanningBenchmark {
 public:
  PlanningBenchmark(const Options& options, std::filesystem::path data)
      : options_(options), data_(std::move(data)), planning_(options.limits) {}

  /// False when a path of ours is not proven free, or a state is not the nearest.
  bool run() const {
    bool proven = true;
    std::printf("Left out of all times: %.0f ns for each metered call\n",
                1e9 * planning_.meterSeconds());
    for (const std::string& name : options_.robots) {
      std::printf("\n## %s\n\n", name.c_str());
      const double begin = cpuSeconds();
      const PlanningProblems problems(data_, name, options_.perSet);
      std::printf("robot and %zu problems read in %s s\n", problems.cases().size(),
                  number(cpuSeconds() - begin).c_str());
      if (options_.neighbours)
        proven = printNeighbours(problems, options_.limits.seed) && proven;
      else if (options_.overhead)
        printOverhead(problems, options_.limits.seed);
      else
        proven = plan(problems) && proven;
    }
    return proven;
  }

 private:
  bool plan(const PlanningProblems& problems) const {
    const double begin = cpuSeconds();
    const Checker empty(problems.robot(), problems.group(), std::make_shared<const World>());
    std::printf("first checker built in %s ms\n", number(1e3 * (cpuSeconds() - begin)).c_str());
    std::vector<PlannedCase> planned;
    for (const PlanningCase& problem : problems.cases()) {
      planned.push_back(planCase(empty, problem, planned.size()));
      if (planned.size() % 50 == 0)
        std::cerr << planned.size() << " of " << problems.cases().size() << " problems\n";
    }
    print(planned);
    return std::ranges::all_of(planned, [](const PlannedCase& c) {
      for (std::size_t i = 0; i < kMethods.size(); ++i) {
        const Attempt& attempt = c.attempts[i];
        if (!kMethods[i].resolution && attempt.solved && attempt.path.verdict != Verdict::Free)
          return false;
      }
      return true;
    });
  }

  /// The methods in turns: another one begins with each problem, and half of the time they go
  /// backwards, so that none always finds the world's memory warm.
  PlannedCase planCase(const Checker& empty, const PlanningCase& problem,
                       std::size_t number) const {
    PlannedCase planned;
    planned.problem = &problem;
    planned.attempts.resize(kMethods.size());
    const double begin = cpuSeconds();
    const auto checker = std::make_shared<const Checker>(empty.withWorld(problem.world));
    planned.building = cpuSeconds() - begin;
    for (std::size_t i = 0; i < kMethods.size(); ++i) {
      const std::size_t count = kMethods.size();
      const bool back = number / count % 2 == 1;
      const std::size_t method = (number + (back ? count - i : i)) % count;
      planned.attempts[method] =
          planning_.attempt(checker, problem, static_cast<std::uint32_t>(number), kMethods[method]);
    }
    for (std::size_t i = 0; i < kMethods.size(); ++i)
      if (!kMethods[i].resolution) planned.attempts[i].building += planned.building;
    return planned;
  }

  static void print(const std::vector<PlannedCase>& planned) {
    std::vector<PlannedCases> sets;
    std::vector<std::string> names;
    PlannedCases all;
    for (const PlannedCase& one : planned) {
      if (names.empty() || names.back() != one.problem->set) {
        names.push_back(one.problem->set);
        sets.emplace_back();
      }
      sets.back().push_back(&one);
      all.push_back(&one);
    }
    names.emplace_back("all");
    sets.push_back(all);
    std::printf("%td problems solved by all methods: times and counts are theirs\n\n",
                std::ranges::count_if(planned, &PlannedCase::solvedByAll));
    printTimes(sets, names);
    std::printf("\n");
    printPaths(sets, names);
    std::printf("\n");
    printSlowest(all, 12);
    std::printf("\n");
    printUnsolved(planned);
  }

  Options options_;
  std::filesystem::path data_;
  Planning planning_;
};

/// Takes an option with a value; false when it cannot.
bool takeOption(const std::string& name, const std::string& text, Options& options) {
  if (name == "--sets" && text == "all") return true;
  const std::optional<double> value = positiveNumber(text);
  if (!value) return false;
  if (name == "--time") {
    options.limits.seconds = *value;
    return true;
  }
  if (*value != std::floor(*value) || *value > 1e9) return false;
  if (name == "--sets") options.perSet = static_cast<std::size_t>(*value);
  if (name == "--seed") options.limits.seed = static_cast<std::uint32_t>(*value);
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
    } else if (word == "--overhead") {
      options.overhead = true;
    } else if (word == "--neighbours") {
      options.neighbours = true;
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
      "planning_benchmark [panda] [ur5] [--sets N|all] [--time S] [--seed N] "
      "[--overhead|--neighbours]",
      [](const auto& options, const auto& data) {
        ompl::msg::noOutputHandler();
        return swept::benchmark::PlanningBenchmark(options, data).run();
      });
}
