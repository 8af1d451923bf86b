// SPDX-License-Identifier: BSD-3-Clause
#include "certify/motion_check.hpp"

#include <optional>
#include <utility>

#include "certify/nearest_points.hpp"
#include "certify/pair_oracle.hpp"
#include "certify/pending_intervals.hpp"
#include "certify/waypoint_segments.hpp"
#include "certify/work_limits.hpp"
#include "simd/kernels/simd_motion.hpp"
#include "simd/search/simd_search.hpp"

namespace swept::detail {

namespace {

/// An interval in which a pair cannot approach by more than this share of the tolerance is not
/// split further. Then the distance at its middle, and so at its begin, is below the tolerance: a
/// motion that keeps more than margin + tolerance is always proven, and freeUntil ends within the
/// tolerance of what stopped it.
constexpr double kStopShare = 0.45;

/// Once a contact is known, the tolerance that first contacts are looked for with, as a share of
/// the motion's. A pair that passes closer than the tolerance must not hide the pair that meets
/// first.
constexpr double kContactShare = 1.0 / 16.0;

class MotionProver {
 public:
  MotionProver(const CheckerModel& model, const JointPath& path, MotionQuery wanted,
               WorkspaceData& workspace, MotionCertificate& certificate)
      : model_(model),
        path_(path),
        workspace_(workspace),
        wanted_(wanted),
        query_(model, workspace),
        certificate_(certificate),
        oracle_(model, path, query_, certificate) {}

  void run() {
    search();
    std::optional<Witness>& witness = certificate_.witness;
    if (wanted_ == MotionQuery::VerdictOnly || !witness || !oracle_.start()) return;
    query_.moveTo(witness->t, 0.0);
    takeNearestPoints(model_, query_, *witness);
  }

 private:
  void search() {
    if (settleInSimd() || !oracle_.start()) return;
    if (!certificate_.witness) searchWhole();
    // Near the tolerance a proof may hang on the directions that neighbouring intervals suggest. A
    // second attempt in another order settles some of what the first left open.
    const bool undecided = undecidedAt_ && !certificate_.witness;
    if (undecided || (certificate_.witness && wanted_ == MotionQuery::FirstContact)) {
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
    if (wanted_ == MotionQuery::VerdictOnly && certificate_.verdict != Verdict::Free) {
      certificate_.freeUntil = 0.0;
    }
  }

  /// The lane tier: proves most motions, refutes most others, and leaves the rest in
  /// workspace.pending. True: it is decided.
  bool settleInSimd() {
    const int lanes = subIntervalsLeft(model_, certificate_.effort);
    SimdMotion motion(model_.simd, model_.kinematics, path_, workspace_.motion, workspace_.simd);
    const bool fits = model_.simd.usable && model_.options.maxIntervals >= kLanes && lanes > 0 &&
                      motion.compile();
    if (!fits) {
      if (oracle_.start()) takeAll(model_, query_, workspace_);
      return false;
    }
    workspace_.simd.mostIntervals = lanes;
    workspace_.simd.mostWaiting = kMostWaiting;
    const SimdGoal goal =
        wanted_ == MotionQuery::VerdictOnly ? SimdGoal::Verdict : SimdGoal::Prefix;
    const SimdAnswer answer = searchMotion(motion, oracle_, goal, workspace_.simd);
    certificate_.effort.lanes += answer.intervals;
    if (answer.kind == SimdAnswer::Kind::Contact) {
      certificate_.verdict = Verdict::Collision;
      if (goal == SimdGoal::Prefix) certificate_.freeUntil = certificate_.witness->t;
      return true;
    }
    if (answer.kind == SimdAnswer::Kind::Free) {
      certificate_.verdict = Verdict::Free;
      certificate_.freeUntil = 1.0;
      return true;
    }
    if (answer.kind == SimdAnswer::Kind::Open) {
      takeRest(workspace_);
    } else if (oracle_.start()) {
      takeAll(model_, query_, workspace_);
    }
    return false;
  }

  /// What examining one interval found out. Pairs still open are in workspace.failed.
  struct Outcome {
    bool contact = false;   ///< at the middle; the witness is recorded
    bool resolved = false;  ///< some open pair moves less than the query's tolerance
  };

  bool isEarliest(double t) const { return !certificate_.witness || t < certificate_.witness->t; }

  bool budgetLeft() const { return workLeft(model_, certificate_.effort); }

  Outcome examine(const PendingInterval& interval, const std::vector<std::uint32_t>& arena,
                  bool dropResolved) {
    const double middle = 0.5 * (interval.begin + interval.end);
    const double half = 0.5 * (interval.end - interval.begin);
    workspace_.failed.clear();
    Outcome outcome;
    if (interval.count == 0) return outcome;
    query_.moveTo(middle, half);
    ++certificate_.effort.intervals;
    for (std::size_t i = interval.first; i < interval.first + interval.count; ++i) {
      const std::uint32_t pair = arena[i];
      if (outcome.contact) {  // not looked at: still open
        workspace_.failed.push_back(pair);
        continue;
      }
      const PairAnswer answer = query_.prove(pair, half);
      ++(answer.culled ? certificate_.effort.culled : certificate_.effort.distances);
      if (answer.status == Separation::Separated) continue;
      const bool atTolerance = answer.travel <= kStopShare * query_.tolerance();
      outcome.resolved = outcome.resolved || atTolerance;
      if (answer.status == Separation::Contact) {
        outcome.contact = true;
        if (isEarliest(middle)) certificate_.witness = query_.witness(pair, middle, answer);
      }
      if (!(atTolerance && dropResolved)) workspace_.failed.push_back(pair);
    }
    return outcome;
  }

  /// All that is pending, a level of the bisection at a time, so that contacts show early wherever
  /// they are. Ends at the first contact, or with the level in which some interval turned out
  /// undecidable.
  void searchWhole() {
    auto& now = workspace_.generation;
    auto& next = workspace_.nextGeneration;
    groupByInterval(workspace_);
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
        if (workspace_.nextArena.size() > kMostWaiting) return giveUp(next.front().begin);
      }
      if (undecidedAt_) return;
      std::swap(now, next);
      std::swap(workspace_.arena, workspace_.nextArena);
    }
  }

  void giveUp(double begin) {
    if (!undecidedAt_ || begin < *undecidedAt_) undecidedAt_ = begin;
  }

  /// From the left: the largest t up to which everything is proven, to within the tolerance, and
  /// the first contact. Contacts on the way move the witness forward in time, and nothing behind it
  /// matters any more. Without a contact the search ends where the proof does. With one it goes on
  /// from there: what ends the proof may be a pair that passes close by, or one of several that are
  /// about to meet.
  void provePrefix() {
    auto& stack = workspace_.generation;
    auto& arena = workspace_.arena;
    stackByTime(workspace_);
    while (!stack.empty()) {
      const PendingInterval interval = stack.back();
      stack.pop_back();
      if (certificate_.witness && interval.begin >= certificate_.witness->t) break;
      const double middle = 0.5 * (interval.begin + interval.end);
      const bool divides = interval.begin < middle && middle < interval.end;
      if (!divides || !budgetLeft()) return stopAt(interval.begin);
      const OpenPairs open = sortOpenPairs(interval, workspace_);
      // Nothing from the contact on matters.
      const bool behind = certificate_.witness && middle >= certificate_.witness->t;
      const std::size_t asked = behind ? 0 : open.onAll;
      const bool met = certificate_.witness.has_value();
      query_.setTolerance((met ? kContactShare : 1.0) * model_.options.tolerance);
      const Outcome outcome =
          examine({interval.begin, interval.end, interval.first, asked}, arena, met);
      if (outcome.resolved && met && interval.begin == 0.0 && meetAtBegin(interval.first, asked))
        return stopAt(0.0);
      // Pairs that are open on a part only wait for that part.
      const auto waiting = arena.begin() + static_cast<std::ptrdiff_t>(interval.first);
      workspace_.failed.insert(workspace_.failed.end(),
                               waiting + static_cast<std::ptrdiff_t>(asked),
                               waiting + static_cast<std::ptrdiff_t>(open.onAll + open.onPart));
      arena.resize(interval.first);
      if (outcome.contact) {
        stack.clear();
        arena.clear();
      }
      const bool tooMany = arena.size() + 2 * workspace_.failed.size() > kMostWaiting;
      if (tooMany || (outcome.resolved && !certificate_.witness)) return stopAt(interval.begin);
      if (outcome.resolved && met) endPrefix(interval.begin);
      if (workspace_.failed.empty()) continue;
      if (!outcome.contact && !behind) push(middle, interval.end);
      push(interval.begin, middle);
    }
    endPrefix(certificate_.witness ? certificate_.witness->t : 1.0);
    certificate_.freeUntil = *prefixEnd_;
  }

  /// Whether one of these pairs of the arena is in contact where the motion begins.
  bool meetAtBegin(std::size_t first, std::size_t count) {
    query_.moveTo(0.0, 0.0);
    for (std::size_t i = first; i < first + count; ++i) {
      const PairAnswer answer = query_.prove(workspace_.arena[i], 0.0);
      ++(answer.culled ? certificate_.effort.culled : certificate_.effort.distances);
      if (answer.status != Separation::Contact) continue;
      certificate_.witness = query_.witness(workspace_.arena[i], 0.0, answer);
      return true;
    }
    return false;
  }

  void endPrefix(double end) {
    if (!prefixEnd_) prefixEnd_ = end;
  }

  void stopAt(double begin) {
    endPrefix(begin);
    certificate_.freeUntil = *prefixEnd_;
    if (!certificate_.witness) undecidedAt_ = begin;
  }

  void push(double begin, double end) {
    auto& arena = workspace_.arena;
    workspace_.generation.push_back({begin, end, arena.size(), workspace_.failed.size()});
    arena.insert(arena.end(), workspace_.failed.begin(), workspace_.failed.end());
  }

  const CheckerModel& model_;
  const JointPath& path_;
  WorkspaceData& workspace_;
  const MotionQuery wanted_;
  PairQuery query_;
  MotionCertificate& certificate_;
  PairOracle oracle_;
  std::optional<double> undecidedAt_;
  std::optional<double> prefixEnd_;  ///< of what is proven; what follows may be searched further
};

/// Takes over what a part says; what lies before it, its effort too, is part of the certificate
/// already.
void addPart(const WaypointSegment& part, MotionCertificate&& own, MotionCertificate& all) {
  all.effort = own.effort;
  const bool open = all.verdict != Verdict::Free;  // an earlier part was left undecided
  if (!open) all.freeUntil = part.timeOf(own.freeUntil);
  if (own.verdict == Verdict::Free) return;
  if (own.verdict == Verdict::Collision) {
    all.verdict = own.verdict;
    all.witness = std::move(own.witness);
    all.witness->t = part.timeOf(all.witness->t);
  } else if (!open) {
    all.verdict = own.verdict;
    all.undecidedAt = part.timeOf(own.undecidedAt);
  }
}

}  // namespace

MotionCertificate certifyMotion(const CheckerModel& model, const JointPath& path,
                                MotionQuery wanted, WorkspaceData& workspace) {
  MotionCertificate certificate;
  if (model.world->obstacles().empty()) {
    MotionProver(model, path, wanted, workspace, certificate).run();
    return certificate;
  }
  certificate.verdict = Verdict::Free;
  WaypointSegments(model, path, workspace).forEach([&](const WaypointSegment& part) {
    MotionCertificate own;
    own.effort = certificate.effort;  // the cap on intervals is for all parts together
    MotionProver(model, part.path, wanted, workspace, own).run();
    addPart(part, std::move(own), certificate);
    const bool settled = certificate.verdict == Verdict::Free;
    if (!settled && !workLeft(model, certificate.effort)) return false;
    return certificate.verdict != Verdict::Collision;
  });
  if (wanted == MotionQuery::VerdictOnly && certificate.verdict != Verdict::Free)
    certificate.freeUntil = 0.0;
  return certificate;
}

MotionCertificate certifyMotion(const CheckerModel& model, std::span<const double> from,
                                std::span<const double> to, MotionQuery wanted,
                                WorkspaceData& workspace) {
  return certifyMotion(model, StraightPath(model.kinematics, from, to), wanted, workspace);
}

}  // namespace swept::detail
