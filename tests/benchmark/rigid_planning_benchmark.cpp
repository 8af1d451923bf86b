// SPDX-License-Identifier: BSD-3-Clause
// Planning for one rigid body in SE(3): certified motions against FCL under OMPL's discrete
// validator, on problems of OMPL.app and one of our own.
//   SWEPT_DATA=DATA rigid_planning_benchmark [PROBLEM...] [--planner NAME] [--time S] [--runs N]
//                                            [--seed N] [--unit M] [--tolerance M]
// Lengths of the data count as inches (--unit 0.0254), so that the tolerance means what it says;
// with
// --unit 1 positions and rotations weigh as in OMPL.app, and --tolerance 0.04 is a millimetre.
// Exit code 1 if a path of ours is not proven free, or an end of a problem is not.
#include <ompl/util/Console.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <set>

#include "data_folder.hpp"
#include "number_argument.hpp"
#include "rigid_planning_motions.hpp"
#include "rigid_planning_tables.hpp"

namespace swept::benchmark {
namespace {

constexpr double kInch = 0.0254;  // m

struct Options {
  std::set<std::string> problems;  ///< empty: all
  RigidLimits limits;
  double unit = kInch;                    ///< m, a length of 1 in the data
  double tolerance = tolerance::kMotion;  ///< m
};

std::vector<RigidProblem> problemsFor(const Options& options) {
  std::vector<RigidProblem> problems{throughAHole()};
  if (const auto data = dataFolder()) {
    for (RigidProblem& problem : readRigidProblems(*data / "rigid"))
      problems.push_back(scaled(std::move(problem), options.unit));
  } else {
    std::printf("all problems but L are skipped: SWEPT_DATA names no folder\n\n");
  }
  if (!options.problems.empty())
    std::erase_if(problems, [&](const RigidProblem& problem) {
      return !options.problems.contains(problem.name);
    });
  return problems;
}

class RigidBenchmark {
 public:
  explicit RigidBenchmark(const Options& options) : options_(options), planning_(options.limits) {}

  /// False when a path of ours, or an end of a problem, is not proven free.
  bool run() {
    std::vector<RigidMotions> motions;
    for (const RigidProblem& problem : problemsFor(options_)) {
      const RigidScene scene(problem, options_.tolerance);
      if (!endsFree(scene, problem.name)) return false;
      motions.push_back(measureMotions(scene, problem.name, options_.limits.seed));
      plan(scene, problem.name);
    }
    print(motions);
    return std::ranges::all_of(runs_, [](const RigidRuns& runs) {
      return runs.method != RigidMethod::Certified ||
             std::ranges::all_of(runs.attempts,
                                 [](const RigidAttempt& a) { return !a.solved || a.path.free(); });
    });
  }

 private:
  static bool endsFree(const RigidScene& scene, const std::string& name) {
    Workspace workspace(scene.checker());
    for (const std::vector<double>* end : {&scene.start(), &scene.goal()}) {
      if (scene.checker().checkState(*end, workspace) == Verdict::Free) continue;
      std::printf("%s: an end is not free\n", name.c_str());
      return false;
    }
    return true;
  }

  /// The methods in turns: another one begins with each run.
  void plan(const RigidScene& scene, const std::string& name) {
    RigidRuns ours{name, RigidMethod::Certified}, peer{name, RigidMethod::Fcl};
    for (unsigned run = 0; run < options_.limits.runs; ++run) {
      const auto certified = [&] {
        ours.attempts.push_back(planning_.attempt(scene, RigidMethod::Certified, run));
      };
      if (run % 2 == 0) certified();
      peer.attempts.push_back(planning_.attempt(scene, RigidMethod::Fcl, run));
      if (run % 2 == 1) certified();
      std::cerr << name << ": run " << run + 1 << " of " << options_.limits.runs << '\n';
    }
    runs_.push_back(std::move(ours));
    runs_.push_back(std::move(peer));
  }

  void print(const std::vector<RigidMotions>& motions) const {
    printRigidMotions(motions);
    std::printf("\n%s, at most %s s of CPU time for each of %u runs\n\n",
                options_.limits.planner.c_str(), number(options_.limits.seconds).c_str(),
                options_.limits.runs);
    printRigidTimes(runs_);
    std::printf("\n");
    printRigidPaths(runs_);
    std::printf("\n");
    printRigidWitnesses(runs_);
  }

  Options options_;
  RigidPlanning planning_;
  std::vector<RigidRuns> runs_;
};

/// Takes an option with a value; false when it cannot.
bool takeOption(const std::string& name, const std::string& text, Options& options) {
  if (name == "--planner") {
    options.limits.planner = text;
    return kRigidPlanners.contains(text);
  }
  const std::optional<double> value = positiveNumber(text);
  if (!value) return false;
  if (name == "--time") options.limits.seconds = *value;
  if (name == "--unit") options.unit = *value;
  if (name == "--tolerance") options.tolerance = *value;
  if (name == "--time" || name == "--unit" || name == "--tolerance") return true;
  if (*value != std::floor(*value) || *value > 1e9) return false;
  if (name == "--runs") options.limits.runs = static_cast<unsigned>(*value);
  if (name == "--seed") options.limits.seed = static_cast<std::uint32_t>(*value);
  return name == "--runs" || name == "--seed";
}

std::optional<Options> optionsOf(int argc, char** argv) {
  const std::set<std::string> known{"L", "cubicles", "twistycool", "piano", "piano_hard"};
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (known.contains(word)) {
      options.problems.insert(word);
    } else {
      if (i + 1 == argc || !takeOption(word, argv[i + 1], options)) return std::nullopt;
      ++i;
    }
  }
  return options;
}

void printUsage() {
  std::cerr << "usage: rigid_planning_benchmark [L] [cubicles] [twistycool] [piano] [piano_hard] "
               "[--planner NAME] [--time S] [--runs N] [--seed N] [--unit M] [--tolerance M]\n"
               "planners:";
  for (const auto& [name, allocate] : kRigidPlanners) std::cerr << ' ' << name;
  std::cerr << '\n';
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  const auto options = swept::benchmark::optionsOf(argc, argv);
  if (!options) {
    swept::benchmark::printUsage();
    return 2;
  }
  ompl::msg::noOutputHandler();
  try {
    return swept::benchmark::RigidBenchmark(*options).run() ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
