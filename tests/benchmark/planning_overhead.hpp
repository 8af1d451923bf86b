// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "motion_samples.hpp"
#include "planning_problems.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "timing.hpp"

/// What OMPL's interfaces cost beyond the checker behind them.
namespace swept::benchmark {

/// Uniform states and motions of one checker, as states of OMPL, asked either way.
class BridgeCalls {
 public:
  /// `length`: of the motions, L2 over the joints (rad and m).
  BridgeCalls(const std::shared_ptr<const Checker>& checker, std::size_t count, double length,
              std::mt19937_64& random)
      : checker_(checker),
        setup_(makeSimpleSetup(checker)),
        conversion_(checker->robot(), checker->group()),
        workspace_(*checker),
        from_(static_cast<std::size_t>(checker->dimension())),
        to_(from_) {
    setup_->getSpaceInformation()->setup();
    MotionSampler sampler(*checker, random);
    for (std::size_t i = 0; i < count; ++i) {
      const BenchMotion motion = sampler.draw(length);
      starts_.push_back(stateOf(motion.from));
      ends_.push_back(stateOf(motion.to));
    }
  }

  int bridgedStates() const {
    int valid = 0;
    const auto& states = setup_->getStateValidityChecker();
    for (const State& state : starts_) valid += states->isValid(state.get()) ? 1 : 0;
    return valid;
  }
  int directStates() {
    int valid = 0;
    for (const State& state : starts_) {
      conversion_.toConfiguration(state.get(), from_);
      valid += checker_->checkState(from_, workspace_) == Verdict::Free ? 1 : 0;
    }
    return valid;
  }
  int bridgedMotions() const {
    int valid = 0;
    const auto& motions = setup_->getSpaceInformation()->getMotionValidator();
    for (std::size_t i = 0; i < starts_.size(); ++i)
      valid += motions->checkMotion(starts_[i].get(), ends_[i].get()) ? 1 : 0;
    return valid;
  }
  int directMotions() {
    int valid = 0;
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      conversion_.toConfiguration(starts_[i].get(), from_);
      conversion_.toConfiguration(ends_[i].get(), to_);
      const MotionCertificate certificate =
          checker_->certifyMotion(from_, to_, workspace_, MotionQuery::VerdictOnly);
      valid += certificate.verdict == Verdict::Free ? 1 : 0;
    }
    return valid;
  }

 private:
  using State = ompl::base::ScopedState<>;

  State stateOf(const std::vector<double>& q) const {
    State state(setup_->getStateSpace());
    conversion_.toState(q, state.get());
    return state;
  }

  std::shared_ptr<const Checker> checker_;
  ompl::geometric::SimpleSetupPtr setup_;
  StateConversion conversion_;
  Workspace workspace_;
  std::vector<double> from_, to_;
  std::vector<State> starts_, ends_;
};

/// ns per call of either way, summed over the worlds; the least of several rounds in each.
struct BridgeCost {
  double direct = 0.0, bridged = 0.0, free = 0.0;
  std::size_t calls = 0;

  /// Throws std::runtime_error when the two ways do not agree.
  template <typename Direct, typename Bridged>
  void add(std::size_t count, const Direct& askChecker, const Bridged& askBridge) {
    constexpr int kRounds = 15;
    int expected = 0, given = 0;
    std::vector<Contestant> ways;
    ways.push_back({.name = "direct", .run = [&] { expected = askChecker(); }});
    ways.push_back({.name = "bridged", .run = [&] { given = askBridge(); }});
    takeTurns(ways, kRounds);
    if (expected != given) throw std::runtime_error("the bridge and the checker disagree");
    direct += 1e9 * ways[0].seconds;
    bridged += 1e9 * ways[1].seconds;
    free += expected;
    calls += count;
  }
  std::vector<std::string> row(const std::string& name) const {
    const auto all = static_cast<double>(calls);
    return {name,
            std::to_string(calls),
            number(100.0 * free / all) + " %",
            number(direct / all),
            number(bridged / all),
            number((bridged - direct) / all),
            number(100.0 * (bridged - direct) / direct, 2) + " %"};
  }
};

/// s of CPU time, the least of several: a bridge builds one for each thread at its first call.
inline double workspaceSeconds(const Checker& checker) {
  constexpr int kRounds = 15;
  std::vector<Contestant> building{{.name = "workspace", .run = [&] { Workspace{checker}; }}};
  takeTurns(building, kRounds);
  return building.front().seconds;
}

/// In the first world of each set. Motions as long as RRTConnect's default range, a fifth of the
/// space's extent.
inline void printOverhead(const PlanningProblems& problems, std::uint64_t seed) {
  constexpr std::size_t kCalls = 600;  // in each world
  const Checker empty(problems.robot(), problems.group(), std::make_shared<const World>());
  const double range = 0.2 * makeStateSpace(empty.robot(), empty.group())->getMaximumExtent();
  std::mt19937_64 random(seed);
  BridgeCost states, motions;
  double workspaces = 0.0;
  int worlds = 0;
  std::string last;
  for (const PlanningCase& problem : problems.cases()) {
    if (problem.set == last) continue;
    last = problem.set;
    const auto checker = std::make_shared<const Checker>(empty.withWorld(problem.world));
    workspaces += workspaceSeconds(*checker);
    ++worlds;
    BridgeCalls calls(checker, kCalls, range, random);
    states.add(
        kCalls, [&] { return calls.directStates(); }, [&] { return calls.bridgedStates(); });
    motions.add(
        kCalls, [&] { return calls.directMotions(); }, [&] { return calls.bridgedMotions(); });
  }
  std::printf("a workspace, which the first call builds, takes %s us\n\n",
              number(1e6 * workspaces / worlds).c_str());
  const MarkdownTable table(
      {"call", "calls", "free", "checker ns", "bridge ns", "more, ns", "more"});
  table.row(states.row("isValid"));
  table.row(motions.row("checkMotion, " + number(range) + " rad"));
}

}  // namespace swept::benchmark
