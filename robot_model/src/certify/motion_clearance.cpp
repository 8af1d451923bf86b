// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "certify/motion_check.hpp"
#include "certify/near_pairs.hpp"
#include "certify/obstacle_clock.hpp"
#include "certify/work_limits.hpp"

namespace swept::detail {

namespace {

/// Branch and bound over intervals and pairs. Distances at the middles give upper bounds; less what
/// the pair can approach within the interval, lower ones. Whatever cannot be below the best upper
/// bound by more than the accuracy is dropped. What a pair can approach along the direction in
/// which it is nearest is the better bound where it moves across that, as bodies do that slide
/// along others.
class ClearanceSearch {
 public:
  /// `budget`: intervals that may be examined, at least 1. `queries`: pairs that may be looked at,
  /// but for the first interval's.
  ClearanceSearch(const CheckerModel& model, double accuracy, int budget, std::int64_t queries,
                  WorkspaceData& workspace)
      : model_(model),
        workspace_(workspace),
        query_(model, workspace),
        accuracy_(accuracy),
        budget_(budget),
        queriesLeft_(queries) {
    found_.lower = std::numeric_limits<double>::infinity();
    found_.upper = std::numeric_limits<double>::infinity();
  }

  MotionClearance run(std::span<const double> from, std::span<const double> to) {
    if (!query_.start(from, to)) {
      found_.lower = 0.0;
      return found_;
    }
    lookAtAll();
    auto& now = workspace_.generation;
    auto& next = workspace_.nextGeneration;
    while (!now.empty() && found_.upper > 0.0) {
      next.clear();
      workspace_.nextArena.clear();
      for (const PendingInterval& interval : now) split(interval);
      std::swap(now, next);
      std::swap(workspace_.arena, workspace_.nextArena);
    }
    found_.lower = std::clamp(found_.lower, 0.0, found_.upper);
    return found_;
  }

  std::int64_t queriesLeft() const { return queriesLeft_; }

 private:
  /// The whole motion, and of all pairs those that are left open: into `generation` and `measured`.
  void lookAtAll() {
    auto& open = workspace_.measured;
    open.clear();
    beginAt(0.5);
    NearGeometries(model_, query_, workspace_).forNearest(0.5, [&](const GeometryPair& pair) {
      --queriesLeft_;
      const double bound = boundPair(pair, 0.5, 0.5);
      if (isOpen(bound))
        open.push_back({pair, bound});
      else
        settle(bound);
      return found_.upper;
    });
    workspace_.generation.clear();
    if (isLast(0, open.size())) {
      for (const MeasuredPair& pair : open) settle(pair.bound);
      return;
    }
    workspace_.arena.resize(open.size());
    std::iota(workspace_.arena.begin(), workspace_.arena.end(), 0U);
    push({0.0, 1.0, 0, open.size()}, workspace_.generation);
  }

  void split(const PendingInterval& interval) {
    const double middle = 0.5 * (interval.begin + interval.end);
    const double half = 0.5 * (interval.end - interval.begin);
    beginAt(middle);
    const std::size_t first = workspace_.nextArena.size();
    const bool last = isLast(first, interval.count);
    for (std::size_t i = interval.first; i < interval.first + interval.count; ++i) {
      const std::uint32_t index = workspace_.arena[i];
      const double bound = boundPair(workspace_.measured[index].pair, middle, half);
      if (!last && isOpen(bound)) {
        workspace_.nextArena.push_back(index);
      } else {
        settle(bound);
      }
    }
    push({interval.begin, interval.end, first, workspace_.nextArena.size() - first},
         workspace_.nextGeneration);
  }

  void beginAt(double middle) {
    query_.moveTo(middle);
    ++found_.intervals;
    --waiting_;
  }

  /// Whether the halves of the current interval may not be looked at, with so many pairs behind
  /// `first` others. What waits has to be looked at: without a bound on it there is none on the
  /// motion.
  bool isLast(std::size_t first, std::size_t count) const {
    return waiting_ > budget_ - found_.intervals - 2 ||
           2 * static_cast<std::int64_t>(count) > queriesLeft_ || first + count > kMostWaiting;
  }

  /// The halves of an interval with what is open of it.
  void push(const PendingInterval& open, std::vector<PendingInterval>& generation) {
    if (open.count == 0) return;
    const double middle = 0.5 * (open.begin + open.end);
    generation.push_back({open.begin, middle, open.first, open.count});
    generation.push_back({middle, open.end, open.first, open.count});
    waiting_ += 2;
    queriesLeft_ -= 2 * static_cast<std::int64_t>(open.count);
  }

  /// Whether shorter intervals are wanted. Of what is no number they say no more.
  bool isOpen(double bound) const { return bound < found_.upper - slack(); }

  /// What is no number says nothing.
  void settle(double bound) { found_.lower = bound > 0.0 ? std::min(found_.lower, bound) : 0.0; }

  /// m. The accuracy, or half of a clearance that is small against it: what is free is shown to be.
  double slack() const {
    return std::min(accuracy_, std::max(0.5 * found_.upper, 0.01 * accuracy_));
  }

  /// m. Lower bound of the pair's distance over the interval; no number: there is none, however
  /// short that is.
  double boundPair(const GeometryPair& pair, double middle, double half) {
    const double travel = query_.travel(pair, half);
    if (!std::isfinite(travel)) return std::numeric_limits<double>::quiet_NaN();
    const double coarse = query_.coarseDistance(pair) - travel;
    if (coarse >= found_.upper) return coarse;
    const PairDistance distance = query_.measure(pair, found_.upper + travel, 0.25 * slack());
    if (distance.upper < found_.upper) {
      found_.upper = distance.upper;
      found_.t = middle;
    }
    const double lower = distance.lower - travel;
    const double wanted = found_.upper - slack();
    if (lower >= wanted || !(wanted > 0.0)) return lower;
    const bool stays = query_.staysBeyond(pair, half, wanted, distance, 0.25 * slack());
    return stays ? wanted : lower;
  }

  const CheckerModel& model_;
  WorkspaceData& workspace_;
  PairQuery query_;
  double accuracy_;
  int budget_;
  int waiting_ = 1;           ///< intervals that are to be examined yet
  std::int64_t queriesLeft_;  ///< less those of the intervals that are to be examined
  MotionClearance found_;
};

}  // namespace

MotionClearance motionClearance(const CheckerModel& model, std::span<const double> from,
                                std::span<const double> to, double accuracy,
                                WorkspaceData& workspace) {
  MotionClearance all;
  all.lower = all.upper = std::numeric_limits<double>::infinity();
  std::int64_t queries = mostMeasures(model);
  EvenParts(model, from, to, workspace).forEach([&](const EvenPart& part) {
    const int budget = model.options.maxIntervals - all.intervals;
    if (budget == 0 || queries <= 0) {  // nothing is known of what is left
      all.lower = 0.0;
      return false;
    }
    ClearanceSearch search(model, accuracy, budget, queries, workspace);
    const MotionClearance own = search.run(part.from, part.to);
    queries = search.queriesLeft();
    if (own.upper < all.upper) {
      all.upper = own.upper;
      all.t = part.timeOf(own.t);
    }
    all.lower = std::min(all.lower, own.lower);
    all.intervals += own.intervals;
    return all.upper > 0.0;
  });
  return all;
}

}  // namespace swept::detail
