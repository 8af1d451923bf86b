// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "certify/motion_check.hpp"
#include "certify/near_pairs.hpp"
#include "certify/waypoint_segments.hpp"
#include "certify/work_limits.hpp"

namespace swept::detail {

namespace {

/// The bounds of one kind of pairs over one part of a motion.
struct KindClearance {
  double lower = std::numeric_limits<double>::infinity();  ///< m
  double upper = std::numeric_limits<double>::infinity();  ///< m
  double t = 0.0;                                          ///< of the part
  /// The pair that attains `upper`; none: no pair is known to come nearer than the others.
  std::optional<GeometryPair> nearest;
};

/// Branch and bound over intervals and pairs. Distances at the middles are upper bounds. Distances
/// less the possible approach within the interval are lower bounds. A pair that cannot be below the
/// best upper bound by more than the accuracy is dropped. The approach along the direction in which
/// a pair is nearest is the better bound if the pair moves across that direction, as sliding bodies
/// do. If clearances are wanted by kind, pairs of different kinds do not limit each other.
class ClearanceSearch {
 public:
  /// `budget`: most intervals to examine, at least 1. `queries`: most pairs to examine after the
  /// first interval. `others`: see motionClearance.
  ClearanceSearch(const CheckerModel& model, double accuracy, bool byKind, int budget,
                  std::int64_t queries, const OtherClearances& others, WorkspaceData& workspace)
      : model_(model),
        workspace_(workspace),
        now_(workspace.work.now),
        next_(workspace.work.next),
        query_(model, workspace),
        accuracy_(accuracy),
        byKind_(byKind),
        budget_(budget),
        queriesLeft_(queries) {
    kinds_[0].upper = others.world;
    kinds_[1].upper = others.self;
  }

  void run(const JointPath& path) {
    if (!query_.start(path)) {
      for (KindClearance& kind : kinds_) kind.lower = 0.0;
      return;
    }
    lookAtAll();
    while (!now_.intervals.empty()) {
      next_.clear();
      for (const OpenInterval& interval : now_.intervals) split(interval);
      std::swap(now_, next_);
    }
    for (KindClearance& kind : kinds_) kind.lower = std::clamp(kind.lower, 0.0, kind.upper);
  }

  /// The clearance of pairs that are, or are not, `self` in the sense of Witness::selfPair. Without
  /// clearances by kind, all pairs are among the latter.
  const KindClearance& ofKind(bool self) const { return kinds_[self ? 1 : 0]; }
  int intervals() const { return intervals_; }
  std::int64_t queriesLeft() const { return queriesLeft_; }

 private:
  /// Examines the whole motion. Puts the open pairs into `measured` and into the first level.
  void lookAtAll() {
    auto& open = workspace_.measured;
    open.clear();
    beginAt(0.5, 0.5);
    const auto look = [&](const GeometryPair& pair) {
      KindClearance& kind = kindOf(pair);
      --queriesLeft_;
      const double bound = boundPair(pair, 0.5, 0.5, kind);
      if (isOpen(bound, kind))
        open.push_back({pair, bound});
      else
        settle(bound, kind);
      return kind.upper;
    };
    NearGeometries near(model_, query_, workspace_);
    byKind_ ? near.forNearestByKind(0.5, look, kinds_[0].upper, kinds_[1].upper)
            : near.forNearest(0.5, look, kinds_[0].upper);
    now_.clear();
    if (isLast(0, open.size())) {
      for (const MeasuredPair& pair : open) settle(pair.bound, kindOf(pair.pair));
      return;
    }
    now_.pairs.resize(open.size());
    std::iota(now_.pairs.begin(), now_.pairs.end(), 0U);
    pushHalves(0.0, 1.0, 0, now_);
  }

  void split(const OpenInterval& interval) {
    beginAt(interval.middle(), interval.half());
    const std::size_t first = next_.pairs.size();
    const bool last = isLast(first, interval.count);
    for (const std::uint32_t index : now_.pairsOf(interval)) {
      const GeometryPair& pair = workspace_.measured[index].pair;
      KindClearance& kind = kindOf(pair);
      const double bound = boundPair(pair, interval.middle(), interval.half(), kind);
      if (!last && isOpen(bound, kind)) {
        next_.pairs.push_back(index);
      } else {
        settle(bound, kind);
      }
    }
    pushHalves(interval.begin, interval.end, first, next_);
  }

  void beginAt(double middle, double half) {
    query_.moveTo(middle, half);
    ++intervals_;
    --waiting_;
  }

  /// Whether the budget forbids to examine the halves of the current interval, with `count` pairs
  /// behind `first` others. Every waiting interval must be examined, since the motion has no bound
  /// without one for each.
  bool isLast(std::size_t first, std::size_t count) const {
    return waiting_ > budget_ - intervals_ - 2 ||
           2 * static_cast<std::int64_t>(count) > queriesLeft_ || first + count > kMostWaiting;
  }

  /// Adds both halves of an interval, with the pairs behind `first`.
  void pushHalves(double begin, double end, std::size_t first, OpenWork& level) {
    const std::size_t count = level.pairs.size() - first;
    if (count == 0) return;
    level.pushHalves(begin, end, first);
    waiting_ += 2;
    queriesLeft_ -= 2 * static_cast<std::int64_t>(count);
  }

  KindClearance& kindOf(const GeometryPair& pair) {
    return kinds_[byKind_ && model_.isSelfPair(pair) ? 1 : 0];
  }

  /// Whether shorter intervals can improve the bound. They cannot for NaN.
  bool isOpen(double bound, const KindClearance& kind) const {
    return kind.upper > 0.0 && bound < kind.upper - slack(kind);
  }

  /// NaN gives no bound.
  static void settle(double bound, KindClearance& kind) {
    kind.lower = bound > 0.0 ? std::min(kind.lower, bound) : 0.0;
  }

  /// m. The accuracy, or half of a clearance that is small against it, so that a free motion is
  /// shown to be free.
  double slack(const KindClearance& kind) const {
    return std::min(accuracy_, std::max(0.5 * kind.upper, 0.01 * accuracy_));
  }

  /// m. Lower bound of the pair's distance over the interval. NaN: there is none, however short the
  /// interval is.
  double boundPair(const GeometryPair& pair, double middle, double half, KindClearance& kind) {
    if (!(kind.upper > 0.0)) return 0.0;  // the least is known already
    const double travel = query_.travel(pair, half);
    if (!std::isfinite(travel)) return std::numeric_limits<double>::quiet_NaN();
    const double coarse = query_.coarseDistance(pair) - travel;
    if (coarse >= kind.upper) return coarse;
    const PairDistance distance = query_.measure(pair, kind.upper + travel, 0.25 * slack(kind));
    if (distance.upper < kind.upper) {
      kind.upper = distance.upper;
      kind.t = middle;
      kind.nearest = pair;
    }
    const double lower = distance.lower - travel;
    const double wanted = kind.upper - slack(kind);
    if (lower >= wanted || !(wanted > 0.0)) return lower;
    const bool stays = query_.staysBeyond(pair, half, wanted, distance, 0.25 * slack(kind));
    return stays ? wanted : lower;
  }

  const CheckerModel& model_;
  WorkspaceData& workspace_;
  OpenWork& now_;   ///< of `measured`, by index: a level of the bisection
  OpenWork& next_;  ///< the next one
  PairQuery query_;
  double accuracy_;
  bool byKind_;
  int budget_;
  int waiting_ = 1;  ///< intervals that are to be examined yet
  int intervals_ = 0;
  std::int64_t queriesLeft_;  ///< less those of the intervals that are to be examined
  std::array<KindClearance, 2> kinds_;
};

/// Adds the bounds of a part of the motion.
void addPart(const CheckerModel& model, const WaypointSegment& part, const KindClearance& own,
             ClearanceInterval& all) {
  all.lower = std::min(all.lower, own.lower);
  if (!own.nearest || !(own.upper < all.upper)) return;
  all.upper = own.upper;
  all.t = part.timeOf(own.t);
  all.bodyA = model.nameOfA(*own.nearest);
  all.bodyB = model.nameOfB(*own.nearest);
}

/// The least over the kinds that are wanted.
void addKinds(ClearanceQuery wanted, MotionClearance& all) {
  ClearanceInterval& whole = all;
  if (wanted == ClearanceQuery::World) {
    whole = all.world;
    all.self = {};
    return;
  }
  if (wanted == ClearanceQuery::Self) {
    whole = all.self;
    all.world = {};
    all.selfPair = !all.bodyA.empty();
    return;
  }
  all.selfPair = all.self.upper < all.world.upper;
  whole = all.selfPair ? all.self : all.world;
  all.lower = std::min(all.self.lower, all.world.lower);
}

}  // namespace

MotionClearance motionClearance(const CheckerModel& model, const JointPath& path, double accuracy,
                                ClearanceQuery wanted, WorkspaceData& workspace,
                                OtherClearances others) {
  const bool byKind = wanted != ClearanceQuery::Least;
  // No clearance is below 0: this skips the pairs of the kind that is not wanted.
  if (wanted == ClearanceQuery::World) others.self = 0.0;
  if (wanted == ClearanceQuery::Self) others.world = 0.0;
  MotionClearance all;
  all.lower = std::numeric_limits<double>::infinity();
  if (byKind) all.world.lower = all.self.lower = all.lower;
  std::int64_t queries = mostMeasures(model);
  WaypointSegments(model, path, workspace).forEach([&](const WaypointSegment& part) {
    const int budget = model.options.maxIntervals - all.intervals;
    if (budget == 0 || queries <= 0) {  // nothing is known of what is left
      all.lower = all.world.lower = all.self.lower = 0.0;
      return false;
    }
    ClearanceSearch search(model, accuracy, byKind, budget, queries, others, workspace);
    search.run(part.path);
    queries = search.queriesLeft();
    all.intervals += search.intervals();
    if (!byKind) {
      const KindClearance& own = search.ofKind(false);
      if (own.nearest) all.selfPair = model.isSelfPair(*own.nearest);
      addPart(model, part, own, all);
      others.world = own.upper;
      return others.world > 0.0;
    }
    addPart(model, part, search.ofKind(false), all.world);
    addPart(model, part, search.ofKind(true), all.self);
    others = {search.ofKind(false).upper, search.ofKind(true).upper};
    return others.world > 0.0 || others.self > 0.0;
  });
  if (byKind) addKinds(wanted, all);
  return all;
}

}  // namespace swept::detail
