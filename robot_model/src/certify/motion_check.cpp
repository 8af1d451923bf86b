// SPDX-License-Identifier: BSD-3-Clause
#include "certify/motion_check.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

namespace swept::detail {

namespace {

/// An interval in which a pair cannot approach by more than this share of the tolerance is not
/// split further. Then the distance at its middle, and so at its begin, is below the tolerance: a
/// motion that keeps more than margin + tolerance is always proven, and freeUntil ends within the
/// tolerance of what stopped it.
constexpr double kStopShare = 0.45;

class MotionProver {
 public:
  MotionProver(const CheckerModel& model, WorkspaceData& workspace)
      : model_(model), workspace_(workspace), query_(model, workspace) {}

  MotionCertificate run(std::span<const double> from, std::span<const double> to,
                        MotionQuery wanted) {
    if (!query_.start(from, to)) return certificate_;
    searchWhole();
    // Near the tolerance a proof may hang on the directions that neighbouring intervals suggest. A
    // second attempt in another order settles some of what the first left open.
    const bool undecided = undecidedAt_ && !certificate_.witness;
    if (undecided || (certificate_.witness && wanted == MotionQuery::FirstContact)) {
      undecidedAt_.reset();
      provePrefix();
    }
    if (certificate_.witness) {
      certificate_.verdict = Verdict::Collision;
    } else if (undecidedAt_) {
      certificate_.undecidedAt = *undecidedAt_;
    } else {
      certificate_.verdict = Verdict::Free;
      certificate_.freeUntil = 1.0;
    }
    if (wanted == MotionQuery::VerdictOnly && certificate_.verdict != Verdict::Free) {
      certificate_.freeUntil = 0.0;
    }
    return certificate_;
  }

 private:
  /// What examining one interval found out. Pairs still open are in workspace.failed.
  struct Outcome {
    bool contact = false;  ///< at the middle; the witness is recorded
    bool resolved =
        false;  ///< some open pair moves less than the tolerance: splitting is pointless
  };

  bool budgetLeft() const { return certificate_.effort.intervals < model_.options.maxIntervals; }

  Outcome examine(const PendingInterval& interval, const std::vector<std::uint32_t>& arena,
                  bool dropResolved) {
    const double middle = 0.5 * (interval.begin + interval.end);
    const double half = 0.5 * (interval.end - interval.begin);
    query_.moveTo(middle);
    ++certificate_.effort.intervals;
    workspace_.failed.clear();
    Outcome outcome;
    for (std::size_t i = interval.first; i < interval.first + interval.count; ++i) {
      const std::uint32_t pair = arena[i];
      if (outcome.contact) {  // not looked at: still open
        workspace_.failed.push_back(pair);
        continue;
      }
      const PairAnswer answer = query_.prove(pair, half);
      ++(answer.culled ? certificate_.effort.culled : certificate_.effort.distances);
      if (answer.status == Separation::Separated) continue;
      const bool atTolerance = answer.travel <= kStopShare * model_.options.tolerance;
      if (answer.status == Separation::Contact) {
        outcome.contact = true;
        outcome.resolved = outcome.resolved || atTolerance;
        certificate_.witness = query_.witness(pair, middle, answer);
        workspace_.failed.push_back(pair);
        continue;
      }
      if (atTolerance) {
        outcome.resolved = true;
        if (dropResolved) continue;
      }
      workspace_.failed.push_back(pair);
    }
    return outcome;
  }

  static PendingInterval whole(std::vector<std::uint32_t>& arena, std::size_t pairs) {
    arena.resize(pairs);
    std::iota(arena.begin(), arena.end(), 0U);
    return {0.0, 1.0, 0, pairs};
  }

  /// All of [0, 1], a level of the bisection at a time, so that contacts show early wherever they
  /// are. Ends at the first contact, or with the level in which some interval turned out
  /// undecidable.
  void searchWhole() {
    auto& now = workspace_.generation;
    auto& next = workspace_.nextGeneration;
    now.assign(1, whole(workspace_.arena, model_.pairs.size()));
    if (model_.pairs.empty()) return;
    while (!now.empty()) {
      next.clear();
      workspace_.nextArena.clear();
      for (const PendingInterval& interval : now) {
        if (!budgetLeft()) return giveUp(interval.begin);
        const Outcome outcome = examine(interval, workspace_.arena, true);
        if (outcome.contact) return;
        if (outcome.resolved) giveUp(interval.begin);
        if (workspace_.failed.empty()) continue;
        const double middle = 0.5 * (interval.begin + interval.end);
        const std::size_t first = workspace_.nextArena.size();
        const std::size_t count = workspace_.failed.size();
        workspace_.nextArena.insert(workspace_.nextArena.end(), workspace_.failed.begin(),
                                    workspace_.failed.end());
        next.push_back({interval.begin, middle, first, count});
        next.push_back({middle, interval.end, first, count});
      }
      if (undecidedAt_) return;
      std::swap(now, next);
      std::swap(workspace_.arena, workspace_.nextArena);
    }
  }

  void giveUp(double begin) {
    if (!undecidedAt_ || begin < *undecidedAt_) undecidedAt_ = begin;
  }

  /// From the left: the largest t up to which everything is proven, to within the tolerance.
  /// Contacts on the way move the witness forward in time, and nothing behind it matters any more.
  void provePrefix() {
    auto& stack = workspace_.generation;
    auto& arena = workspace_.arena;
    stack.assign(1, whole(arena, model_.pairs.size()));
    while (!stack.empty()) {
      const PendingInterval interval = stack.back();
      stack.pop_back();
      certificate_.freeUntil = interval.begin;
      if (certificate_.witness && interval.begin >= certificate_.witness->t) return;
      if (!budgetLeft()) return stopAt(interval.begin);
      const Outcome outcome = examine(interval, arena, false);
      arena.resize(interval.first);
      if (workspace_.failed.empty()) continue;
      if (outcome.resolved) return stopAt(interval.begin);
      const double middle = 0.5 * (interval.begin + interval.end);
      if (outcome.contact) {
        stack.clear();
        arena.clear();
      } else {
        push(middle, interval.end);
      }
      push(interval.begin, middle);
    }
    certificate_.freeUntil = certificate_.witness ? certificate_.witness->t : 1.0;
  }

  void stopAt(double begin) {
    if (!certificate_.witness) undecidedAt_ = begin;
  }

  void push(double begin, double end) {
    auto& arena = workspace_.arena;
    workspace_.generation.push_back({begin, end, arena.size(), workspace_.failed.size()});
    arena.insert(arena.end(), workspace_.failed.begin(), workspace_.failed.end());
  }

  const CheckerModel& model_;
  WorkspaceData& workspace_;
  PairQuery query_;
  MotionCertificate certificate_;
  std::optional<double> undecidedAt_;
};

}  // namespace

MotionCertificate certifyMotion(const CheckerModel& model, std::span<const double> from,
                                std::span<const double> to, MotionQuery wanted,
                                WorkspaceData& workspace) {
  return MotionProver(model, workspace).run(from, to, wanted);
}

}  // namespace swept::detail
