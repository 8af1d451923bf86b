// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

/// Branch and bound over intervals and pairs, those first that may come nearest. Distances at the
/// middles are upper bounds. A pair is settled on an interval once it is proven to keep the best
/// upper bound less the accuracy: by the balls and boxes around the two, or along the direction in
/// which they are nearest. The latter is the better bound if the pair moves across that direction,
/// as sliding bodies do. If clearances are wanted by kind, pairs of different kinds do not limit
/// each other.
class ClearanceSearch {
 public:
  /// `budget`: most intervals to examine, at least 1. `queries`: most pairs to examine after the
  /// first interval. `others`: see motionClearance.
  ClearanceSearch(const CheckerModel& model, double accuracy, bool byKind, int budget,
                  std::int64_t queries, const OtherClearances& others, WorkspaceData& workspace)
      : model_(model),
        workspace_(workspace),
        work_(workspace.clearance),
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
    work_.clear();
    beginWithAll();
    while (!work_.parts.empty()) {
      std::ranges::pop_heap(work_.parts, isLater);
      const ClearancePart part = work_.parts.back();
      work_.parts.pop_back();
      divide(part);
    }
    for (KindClearance& kind : kinds_) kind.lower = std::clamp(kind.lower, 0.0, kind.upper);
  }

  /// The clearance of pairs that are, or are not, `self` in the sense of Witness::selfPair. Without
  /// clearances by kind, all pairs are among the latter.
  const KindClearance& ofKind(bool self) const { return kinds_[self ? 1 : 0]; }
  int intervals() const { return intervals_; }
  std::int64_t queriesLeft() const { return queriesLeft_; }

 private:
  static bool isLater(const ClearancePart& a, const ClearancePart& b) {
    return a.excess > b.excess;
  }

  /// Examines the middle of the motion, for upper bounds, and all pairs over the whole motion.
  void beginWithAll() {
    constexpr double kMiddle = 0.5, kHalf = 0.5;
    query_.moveTo(kMiddle, kHalf);
    ++intervals_;
    NearGeometries near(model_, query_, workspace_);
    const auto measure = [&](const GeometryPair& pair) {
      KindClearance& kind = kindOf(pair);
      measureAt(kMiddle, pair, kind.upper, kind);
      return kind.upper;
    };
    byKind_ ? near.forNearestByKind(0.0, measure, kinds_[0].upper, kinds_[1].upper)
            : near.forNearest(0.0, measure, kinds_[0].upper);
    near.collectNearer(kHalf, kinds_[0].upper, kinds_[byKind_ ? 1 : 0].upper);
    for (const PairBound& bound : workspace_.bounds) {
      const auto index = static_cast<std::uint32_t>(work_.measured.size());
      work_.measured.push_back({.pair = near.pairOf(bound)});
      keep({index, bound.lower});
    }
    workspace_.bounds.clear();
    examine(0.0, 1.0, 0, 0);
  }

  /// Both halves of an interval, if one of its pairs still matters.
  void divide(const ClearancePart& part) {
    const std::size_t first = work_.pairs.size();
    for (std::size_t i = part.first; i < part.first + part.count; ++i) keep(work_.pairs[i]);
    const std::size_t count = work_.pairs.size() - first;
    if (count == 0) return;
    if (!mayDivide(count)) {
      for (std::size_t i = first; i < first + count; ++i) settle(work_.pairs[i]);
      work_.pairs.resize(first);
      return;
    }
    for (const bool later : {false, true}) {
      const double begin = later ? part.middle() : part.begin;
      const double end = later ? part.end : part.middle();
      query_.moveTo(0.5 * (begin + end), 0.5 * (end - begin));
      ++intervals_;
      examine(begin, end, first, count);
    }
  }

  /// The pairs of a range, or, of the whole motion, all that are there. What stays open becomes a
  /// part.
  void examine(double begin, double end, std::size_t from, std::size_t count) {
    ClearancePart part{.begin = begin, .end = end};
    part.excess = std::numeric_limits<double>::infinity();
    const bool whole = count == 0;
    if (whole) count = work_.pairs.size();
    part.first = whole ? 0 : work_.pairs.size();
    queriesLeft_ -= static_cast<std::int64_t>(count);
    std::size_t open = 0;
    for (std::size_t i = from; i < from + count; ++i) {
      ClearanceWork::Pair pair = work_.pairs[i];
      MeasuredPair& measured = work_.measured[pair.index];
      KindClearance& kind = kindOf(measured.pair);
      if (isOpen(pair.lower, kind)) {
        const double lower = boundPair(measured, part.middle(), part.half(), kind);
        // NaN stays.
        if (!(lower <= pair.lower)) pair.lower = lower;
      }
      if (!isOpen(pair.lower, kind)) {
        settle(pair);
        continue;
      }
      part.excess = std::min(part.excess, pair.lower - kind.upper);
      if (whole)
        work_.pairs[open] = pair;
      else
        work_.pairs.push_back(pair);
      ++open;
    }
    if (whole) work_.pairs.resize(open);
    part.count = open;
    if (open == 0) return;
    work_.parts.push_back(part);
    std::ranges::push_heap(work_.parts, isLater);
  }

  /// Whether the caps allow to examine both halves of an interval with so many pairs.
  bool mayDivide(std::size_t count) const {
    return intervals_ + 2 <= budget_ && 2 * static_cast<std::int64_t>(count) <= queriesLeft_ &&
           work_.pairs.size() + 2 * count <= kMostWaiting;
  }

  KindClearance& kindOf(const GeometryPair& pair) {
    return kinds_[byKind_ && model_.isSelfPair(pair) ? 1 : 0];
  }

  /// m. What settles a pair.
  double wanted(const KindClearance& kind) const { return kind.upper - slack(kind); }

  /// Whether shorter intervals can improve the bound. They cannot for NaN.
  bool isOpen(double bound, const KindClearance& kind) const {
    return kind.upper > 0.0 && bound < wanted(kind);
  }

  /// Keeps an open pair.
  void keep(const ClearanceWork::Pair& pair) {
    if (isOpen(pair.lower, kindOf(work_.measured[pair.index].pair)))
      work_.pairs.push_back(pair);
    else
      settle(pair);
  }

  /// NaN gives no bound.
  void settle(const ClearanceWork::Pair& pair) {
    KindClearance& kind = kindOf(work_.measured[pair.index].pair);
    const double bound = pair.lower;
    kind.lower = bound > 0.0 ? std::min(kind.lower, bound) : 0.0;
  }

  /// m. The accuracy, or half of a clearance that is small against it, so that a free motion is
  /// shown to be free.
  double slack(const KindClearance& kind) const {
    return std::min(accuracy_, std::max(0.5 * kind.upper, 0.01 * accuracy_));
  }

  /// An upper bound, if the pair is nearer than the others at the current t. `enough` (m): a larger
  /// distance need not be exact.
  PairDistance measureAt(double t, const GeometryPair& pair, double enough, KindClearance& kind) {
    const PairDistance distance = query_.measure(pair, enough, kShare * slack(kind));
    if (distance.upper < kind.upper) {
      kind.upper = distance.upper;
      kind.t = t;
      kind.nearest = pair;
    }
    return distance;
  }

  /// m. Lower bound of the pair's distance over the interval. NaN: there is none, however short the
  /// interval is.
  double boundPair(MeasuredPair& measured, double middle, double half, KindClearance& kind) {
    const GeometryPair& pair = measured.pair;
    const double travel = query_.travel(pair, half);
    if (!std::isfinite(travel)) return std::numeric_limits<double>::quiet_NaN();
    double lower = query_.coarseBound(pair, half);
    if (lower >= wanted(kind)) return lower;
    HullSeparation hulls = query_.hullBound(pair, half, measured.normal);
    lower = std::max(lower, hulls.least);
    if (lower >= wanted(kind) || isTooLong(measured, travel, half, hulls, kind)) return lower;
    const PairDistance distance = measureAt(middle, pair, wanted(kind) + travel, kind);
    lower = std::max(lower, distance.lower - travel);
    if (lower >= wanted(kind) || !(distance.upper > 0.0)) return lower;
    // The direction between the points is off by much more than their distance, which large bodies
    // do not forgive.
    const Eigen::Vector3d across =
        distance.normal.isZero(0.0) ? distance.pointB - distance.pointA : distance.normal;
    if (across.isZero(0.0)) return lower;
    measured.normal = across.normalized();
    measured.distance = distance.upper;
    measured.half = half;
    hulls = query_.hullBound(pair, half, measured.normal);
    lower = std::max(lower, hulls.least);
    measured.hollow = hulls.atMiddle < distance.lower - slack(kind);
    if (lower >= wanted(kind) || !measured.hollow) return lower;
    // What is between the hull and the body itself counts: each part by itself.
    const double accuracy = kShare * slack(kind);
    const bool stays = query_.staysBeyond(pair, half, wanted(kind), measured.normal, accuracy);
    return stays ? wanted(kind) : lower;
  }

  /// Whether only a shorter interval promises more. `hulls`: along the direction that was the best
  /// when the pair was measured last.
  bool isTooLong(const MeasuredPair& measured, double travel, double half,
                 const HullSeparation& hulls, const KindClearance& kind) const {
    // What was measured long ago says little.
    if (measured.hollow)
      return travel > kHopeless * (measured.distance - wanted(kind)) &&
             half > kStale * measured.half;
    const double beyond = hulls.atMiddle - wanted(kind);
    const bool hopeless = hulls.atMiddle - hulls.least > kHopeless * beyond;
    // Along the direction between the bounding volumes the hulls may be much nearer than they are.
    if (measured.normal.isZero(0.0))
      return !(beyond > 0.0) && travel > model_.robotGeometry[measured.pair.a].radius;
    return hopeless && hulls.atMiddle > kind.upper;
  }

  /// Of the slack: accuracy of distances.
  static constexpr double kShare = 0.25;
  /// A pair that approaches by so many times what it may is not proven by a better direction.
  static constexpr double kHopeless = 2.0;
  /// Of the interval in which a pair was measured: one so much shorter is measured anew.
  static constexpr double kStale = 0.25;

  const CheckerModel& model_;
  WorkspaceData& workspace_;
  ClearanceWork& work_;
  PairQuery query_;
  double accuracy_;
  bool byKind_;
  int budget_;
  int intervals_ = 0;
  std::int64_t queriesLeft_;
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
