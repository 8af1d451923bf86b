// SPDX-License-Identifier: BSD-3-Clause
// A robot against itself, in an empty world: one state at a time and many at once, beside FCL.
//   self_collision_benchmark [--states N] [--only ROBOT]
#include <array>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <numeric>

#include "bench/clock.hpp"
#include "data_folder.hpp"
#include "exit_code.hpp"
#include "self_collision_judge.hpp"
#include "self_collision_robots.hpp"
#include "timing.hpp"

namespace swept::benchmark {
namespace {

struct Options {
  int states = 2000;
  std::string only;
};

constexpr int kPasses = 5;
constexpr std::array kVerdicts{Verdict::Free, Verdict::Collision, Verdict::Undecided};

/// What one way to answer takes: ns per state, the least of all passes.
struct Costs {
  std::vector<double> least;

  explicit Costs(std::size_t states = 0) : least(states, std::numeric_limits<double>::infinity()) {}
  void take(std::size_t i, double nanoseconds) { least[i] = std::min(least[i], nanoseconds); }

  /// Of the states with one verdict.
  struct Summary {
    double median = 0.0, mean = 0.0;
    std::string text() const { return number(median, 4) + " / " + number(mean, 4); }
  };
  Summary of(const std::vector<std::size_t>& states) const {
    std::vector<double> some;
    for (const std::size_t i : states) some.push_back(least[i]);
    if (some.empty()) return {};
    Summary summary;
    summary.mean =
        std::accumulate(some.begin(), some.end(), 0.0) / static_cast<double>(some.size());
    const auto middle = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
    std::nth_element(some.begin(), middle, some.end());
    summary.median = *middle;
    return summary;
  }
};

/// The states of one robot, sorted by what swept says of them.
struct States {
  std::size_t dimension = 0;
  std::vector<double> values;
  std::vector<Verdict> verdicts;

  std::size_t count() const { return verdicts.size(); }
  std::span<const double> at(std::size_t i) const {
    return std::span(values).subspan(i * dimension, dimension);
  }
  std::vector<std::size_t> with(Verdict verdict) const {
    std::vector<std::size_t> some;
    for (std::size_t i = 0; i < count(); ++i)
      if (verdicts[i] == verdict) some.push_back(i);
    return some;
  }
  std::vector<double> valuesOf(const std::vector<std::size_t>& some) const {
    std::vector<double> result;
    for (const std::size_t i : some) result.insert(result.end(), at(i).begin(), at(i).end());
    return result;
  }
};

States sample(const Checker& checker, int count, Workspace& workspace) {
  States states;
  states.dimension = static_cast<std::size_t>(checker.dimension());
  states.values = randomStates(checker, count, 1);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
    states.verdicts.push_back(checker.checkState(
        std::span(states.values).subspan(i * states.dimension, states.dimension), workspace));
  return states;
}

/// ns per state of a batch of one verdict alone. By the thread's own time: a batch takes
/// milliseconds, in which other programs interrupt it.
double batchCost(const Checker& checker, const States& states, const std::vector<std::size_t>& some,
                 Workspace& workspace) {
  if (some.empty()) return 0.0;
  const std::vector<double> values = states.valuesOf(some);
  std::vector<Verdict> verdicts(some.size());
  double least = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < kPasses; ++pass) {
    const double start = cpuSeconds();
    checker.checkStates(values, verdicts, workspace);
    least = std::min(least, 1e9 * (cpuSeconds() - start));
  }
  for (std::size_t i = 0; i < some.size(); ++i)
    if (verdicts[i] != states.verdicts[some[i]])
      throw std::runtime_error("a batch answers other than state by state");
  return least / static_cast<double>(some.size());
}

class SelfBenchmark {
 public:
  explicit SelfBenchmark(const Options& options) : options_(options) {}

  /// False when an answer differs from FCL's and nothing explains it.
  bool run() {
    const auto data = dataFolder();
    bool any = false;
    for (const SelfCase& which : selfCases(data.value_or(""))) {
      if (!options_.only.empty() && !which.name.starts_with(options_.only)) continue;
      any = true;
      if (which.needsData && !data)
        std::printf("\n## %s\n\nskipped: SWEPT_DATA is not set\n", which.name.c_str());
      else
        robot(which);
    }
    if (!any) throw std::runtime_error("--only: no robot's name begins with " + options_.only);
    return unexplained_ == 0;
  }

 private:
  void robot(const SelfCase& which) {
    const auto robot = loadSelf(which);
    const Checker checker = selfChecker(robot);
    Workspace workspace(checker);
    const States states = sample(checker, options_.states, workspace);
    std::printf("\n## %s\n\n%d variables, %zu pairs of links\n", which.name.c_str(),
                checker.dimension(), checker.checkedPairs().size());
    Costs ours(states.count());
    for (int pass = 0; pass < kPasses; ++pass)
      for (std::size_t i = 0; i < states.count(); ++i) {
        Verdict verdict = Verdict::Undecided;
        ours.take(i, clock_.time([&] { verdict = checker.checkState(states.at(i), workspace); }));
        if (verdict != states.verdicts[i])
          throw std::runtime_error("a state has another verdict the second time");
      }
#ifdef SWEPT_HAS_FCL
    beside(checker, states, ours, workspace);
#else
    const MarkdownTable table({"states", "number", "swept", "swept batch"});
    for (const Verdict verdict : kVerdicts)
      table.row(ownOf(checker, states, ours, workspace, verdict).cells);
#endif
  }

  /// One kind of states, and what they cost ours.
  struct Own {
    std::vector<std::size_t> states;
    double mean, batch;  ///< ns
    std::vector<std::string> cells;
  };
  Own ownOf(const Checker& checker, const States& states, const Costs& ours, Workspace& workspace,
            Verdict verdict) const {
    Own own{states.with(verdict), 0.0, 0.0, {}};
    own.mean = ours.of(own.states).mean;
    own.batch = batchCost(checker, states, own.states, workspace);
    own.cells = {verdict == Verdict::Free        ? "free"
                 : verdict == Verdict::Collision ? "colliding"
                                                 : "undecided",
                 std::to_string(own.states.size()), ours.of(own.states).text(),
                 number(own.batch, 4)};
    return own;
  }

#ifdef SWEPT_HAS_FCL
  void beside(const Checker& checker, const States& states, const Costs& ours,
              Workspace& workspace) {
    FclSelf fcl(checker);
    SelfJudge judge(checker, fcl);
    Costs placing(states.count()), turn(states.count()), tree(states.count());
    std::vector<char> hits(states.count());
    for (int pass = 0; pass < kPasses; ++pass)
      for (std::size_t i = 0; i < states.count(); ++i) {
        bool inTurn = false, byTree = false;
        const std::span<const double> q = states.at(i);
        placing.take(i, clock_.time([&] { fcl.place(q); }));
        turn.take(i, clock_.time([&] { inTurn = fcl.place(q) && fcl.collidesInTurn(); }));
        tree.take(i, clock_.time([&] { byTree = fcl.place(q) && fcl.collidesByTree(); }));
        if (inTurn != byTree) throw std::runtime_error("FCL contradicts itself");
        hits[i] = inTurn;
      }
    const MarkdownTable table({"states", "number", "swept", "swept batch", "FCL, pairs in turn",
                               "FCL, tree", "FCL's placing", "swept / FCL", "batch / FCL"});
    for (const Verdict verdict : kVerdicts) {
      Own own = ownOf(checker, states, ours, workspace, verdict);
      if (own.states.empty()) continue;
      const double best = std::min(turn.of(own.states).mean, tree.of(own.states).mean);
      for (const Costs* costs : {&turn, &tree, &placing})
        own.cells.push_back(costs->of(own.states).text());
      own.cells.push_back(number(own.mean / best, 2));
      own.cells.push_back(number(own.batch / best, 2));
      table.row(own.cells);
    }
    std::printf("\n");
    for (std::size_t i = 0; i < states.count(); ++i) {
      if (states.verdicts[i] == Verdict::Undecided) continue;
      if ((states.verdicts[i] == Verdict::Collision) != (hits[i] != 0)) judge.judge(states.at(i));
    }
    judge.print();
    unexplained_ += judge.unexplained();
  }
#endif

  Options options_;
  BenchClock clock_;
  int unexplained_ = 0;
};

std::optional<Options> optionsOf(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    if (i + 1 == argc) return std::nullopt;
    if (name == "--only") {
      options.only = argv[i + 1];
    } else if (name == "--states") {
      options.states = std::atoi(argv[i + 1]);
      if (options.states < 1) return std::nullopt;
    } else {
      return std::nullopt;
    }
  }
  return options;
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  return swept::benchmark::exitCodeOf(
      swept::benchmark::optionsOf(argc, argv),
      "self_collision_benchmark [--states N] [--only ROBOT]",
      [](const auto& options) { return swept::benchmark::SelfBenchmark(options).run(); });
}
