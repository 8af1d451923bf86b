// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/slice_descent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "narrowphase/convex_pair.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// No unit. Pieces that approach by more than this share of their size are left to shorter
/// intervals. On the piano in the apartment (Pan, Chitta, Manocha 2012), half and twice this value
/// take 1.36 and 1.14 times as long.
constexpr double kFast = 1.0 / 32.0;

/// No unit. Accuracy of the distance of the hulls, relative to the approach of the whole bodies.
constexpr double kHullAccuracy = 0.1;

double diameterOf(const Piece& piece) {
  const auto& half = piece.box.half;
  return 2.0 *
         std::sqrt(static_cast<double>(half[0]) * half[0] + static_cast<double>(half[1]) * half[1] +
                   static_cast<double>(half[2]) * half[2]);
}

}  // namespace

SliceDescent::SliceDescent(const Side& a, const Side& b, const MotionSlice& slice, const Goal& goal,
                           std::vector<OpenPair>& open, ContinuousEffort& effort)
    : a_(a),
      b_(b),
      slice_(slice),
      goal_(goal),
      motions_(a, b, slice.a_from_b, &slice.approach),
      pieces_(a, b, slice.a_from_b),
      open_(open),
      begin_(open.size()),
      effort_(effort) {}

void SliceDescent::look(const OpenPair& pair) {
  if (contact_) {
    open_.push_back(pair);
    return;
  }
  const Part a = part(true, pieces_.piece(true, pair.placeA));
  const Part b = part(false, pieces_.piece(false, pair.placeB));
  Known known{pair.direction.cast<double>()};
  if (!a.piece.isLeaf() || !b.piece.isLeaf()) {
    const PartApproach approach(slice_.approach, a.motion, b.motion);
    const bool roots = pair.placeA < 0 && pair.placeB < 0;
    if (roots && areHullsApart(approach, known)) return;
    // Children are tested together; those that would be left again may be far away by now.
    const bool ofA = !a.piece.isLeaf();
    if (!roots && isTooFast(a, b, approach) &&
        isApart(pieces_.gap((ofA ? a : b).piece, ofA, (ofA ? b : a).piece), approach, known)) {
      return;
    }
  }
  descend(a, b, known);
}

// Lemma: the approach that an interval subtracts from a separation shrinks at least in proportion
// to the interval. A gap along n that exceeds `required` and a share s of the approach is therefore
// enough for the share s of half the interval.
SliceDescent::Proven SliceDescent::provenBy(double gap, const Vector3d& n,
                                            const PartApproach& approach) const {
  const double required = slice_.approach.required;
  if (!(gap > required)) return {0.0, 0.0};
  const PartApproach::Loss loss = approach.lossAlong(n);
  const auto share = [&](double lost) {
    if (gap > required + lost) return 1.0;
    const double part = (gap - required) / lost;
    return part > 0.0 ? std::min(part, 1.0) * (1.0 - 1e-12) : 0.0;
  };
  return {share(loss.before), share(loss.after)};
}

// Without a guess: many hulls overlap, and their direction says nothing.
bool SliceDescent::areHullsApart(const PartApproach& approach, Known& known) {
  ++effort_.leafTests;
  const double accuracy = std::max(goal_.accuracy, kHullAccuracy * approach.most());
  const GjkResult found =
      convexPair(a_.around(), b_.around(), slice_.a_from_b, Vector3d::Zero(),
                 detail::Goal(approach), goal_.margin, accuracy, GjkMode::Exact);
  known = {found.normal, provenBy(found.lower, found.normal, approach)};
  return found.satisfied;
}

/// Whether shorter intervals prove more than smaller pieces: those of the larger node, which is
/// divided next, or the leaves themselves.
bool SliceDescent::isTooFast(const Part& a, const Part& b, const PartApproach& approach) const {
  double diameter = 0.0;
  if (a.piece.isLeaf() && b.piece.isLeaf()) {
    diameter = std::max(diameterOf(a.piece), diameterOf(b.piece));
  } else {
    diameter = diameterOf(PiecePair::isLarger(a.piece, b.piece) ? a.piece : b.piece);
  }
  const double moved = approach.most() - slice_.approach.required;
  return moved > std::max(kFast * diameter, goal_.divideBelow);
}

void SliceDescent::markUnresolved(const Part& a, const Part& b, const Known& known,
                                  double approach) {
  open_.push_back({a.piece.place, b.piece.place, known.direction.cast<float>()});
  approach_ = std::max(approach_, approach);
  proven_.before = std::min(proven_.before, known.proven.before);
  if (!(known.proven.after < proven_.after)) return;
  proven_.after = known.proven.after;
  nearest_.reset();
  if (a.piece.isLeaf() && b.piece.isLeaf()) nearest_ = open_.back();
}

void SliceDescent::descend(const Part& a, const Part& b, const Known& known) {
  const PartApproach approach(slice_.approach, a.motion, b.motion);
  const bool whole = a.piece.isWhole() && b.piece.isWhole();
  if (!whole && isTooFast(a, b, approach)) {
    markUnresolved(a, b, known, approach.most() - slice_.approach.required);
  } else if (a.piece.isLeaf() && b.piece.isLeaf()) {
    testLeaves(a, b, approach, known.direction);
  } else {
    WideNode room;
    const PiecePair::Split split = pieces_.split(a.piece, b.piece, room);
    descendInto(split, split.ofA ? b : a, approach.most(), known.direction);
  }
}

void SliceDescent::descendInto(const PiecePair::Split& split, const Part& other, double beyond,
                               const Vector3d& guess) {
  PiecePair::Bounds lower;
  BoxDirections directions;
  pieces_.boundChildren(split, other.piece, beyond, lower, &directions);
  ++effort_.volumeTests;
  std::array<int, WideNode::kLanes> order;
  int count = 0;
  for (int lane = 0; lane < split.node->count; ++lane) {
    if (lower[lane] > beyond) continue;
    int at = count++;
    for (; at > 0 && lower[order[at - 1]] > lower[lane]; --at) order[at] = order[at - 1];
    order[at] = lane;
  }
  for (int i = 0; i < count; ++i) {
    const int lane = order[i];
    const Piece piece = PiecePair::child(split, lane);
    if (contact_) {
      open_.push_back({split.ofA ? piece.place : other.piece.place,
                       split.ofA ? other.piece.place : piece.place});
      continue;
    }
    const Part child = part(split.ofA, piece);
    Known known{guess};
    const Part &a = split.ofA ? child : other, &b = split.ofA ? other : child;
    const PartApproach approach(slice_.approach, a.motion, b.motion);
    if (lower[lane] > approach.most()) continue;
    if (lower[lane] > 0.0F) {
      const BoxGap gap = pieces_.gap(piece, split.ofA, other.piece, directions.of(lane));
      if (isApart(gap, approach, known)) continue;
    }
    descend(a, b, known);
  }
}

bool SliceDescent::isApart(const BoxGap& gap, const PartApproach& approach, Known& known) const {
  if (!(gap.value > 0.0)) return false;
  known = {gap.direction, provenBy(gap.value, gap.direction, approach)};
  return gap.value > approach.along(gap.direction);
}

void SliceDescent::testLeaves(const Part& a, const Part& b, const PartApproach& approach,
                              const Vector3d& guess) {
  ++effort_.leafTests;
  PiecePair::Leaves leaves;
  pieces_.place(a.piece, b.piece, leaves);
  const GjkResult found =
      convexPair(leaves.a, leaves.b, leaves.a_from_b, guess, detail::Goal(approach), goal_.margin,
                 goal_.accuracy, GjkMode::Exact);
  if (found.satisfied) return;
  markUnresolved(a, b, {found.normal, provenBy(found.lower, found.normal, approach)},
                 approach.most() - slice_.approach.required);
  if (!(found.upper <= goal_.margin)) return;
  contact_ = Contact{found.pointA + leaves.centerA, found.pointB + leaves.centerA};
  std::swap(open_[begin_], open_.back());
}

}  // namespace swept::detail
