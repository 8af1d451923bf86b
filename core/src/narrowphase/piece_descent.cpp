// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/piece_descent.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "cover/nearest.hpp"
#include "narrowphase/convex_pair.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Postponed pairs of pieces, the nearest first. Its size is fixed: a pair that finds no room is
/// tested at once, only in a less good order.
class WaitingPairs {
 public:
  struct Pair {
    float lower;  ///< m, proven distance
    int placeA;
    int placeB;
  };
  bool isFull() const { return count_ == kMost; }
  bool isEmpty() const { return count_ == 0; }
  void push(const Pair& pair) {
    pairs_[count_++] = pair;
    std::push_heap(pairs_.begin(), pairs_.begin() + count_, isFarther);
  }
  Pair pop() {
    std::pop_heap(pairs_.begin(), pairs_.begin() + count_, isFarther);
    return pairs_[--count_];
  }

 private:
  static constexpr int kMost = 1024;
  static bool isFarther(const Pair& a, const Pair& b) { return a.lower > b.lower; }
  std::array<Pair, kMost> pairs_;
  int count_ = 0;
};

class PieceDescent {
 public:
  PieceDescent(const Side& a, const Side& b, const Isometry3d& a_from_b,
               const PieceMotions& motions, PieceFindings& found)
      : a_(a),
        b_(b),
        goal_(found.asked),
        motions_(motions),
        pieces_(a, b, a_from_b),
        found_(found) {}

  void run(const std::optional<LikelyNearest>& first) {
    if (first && isNearest(*first)) return;
    begin(pieces_.rootA(), pieces_.rootB());
    while (!waiting_.isEmpty() && !found_.inContact()) {
      const WaitingPairs::Pair next = waiting_.pop();
      if (next.lower > found_.settledBeyond({})) return found_.settle(next.lower);
      begin(pieces_.piece(true, next.placeA), pieces_.piece(false, next.placeB));
    }
    // Contact at a distance ends the search; the remaining pairs may be nearer.
    if (!waiting_.isEmpty()) found_.settle(waiting_.pop().lower);
  }

 private:
  /// A piece and its motion, if that still matters.
  struct Part {
    Piece piece;
    PartMotion motion;
  };
  static Piece leaf(const Side& side, int primitive) {
    return primitive < 0 ? PiecePair::rootOf(side) : Piece{-1, primitive, -1, {}};
  }

  /// Measures the pair, and whether no other is nearer.
  bool isNearest(const LikelyNearest& pair) {
    testLeaves(leaf(a_, pair.primitiveA), leaf(b_, pair.primitiveB), std::nullopt,
               found_.result.hint);
    if (found_.inContact()) {
      found_.settle(0.0);
      return true;
    }
    if (!(pair.lower > 0.0) || found_.result.upper - pair.lower > goal_.tolerance) return false;
    found_.settle(pair.lower);
    found_.result.normal = pair.normal;
    return true;
  }

  Part part(bool ofA, const Piece& piece) const { return {piece, motionOf(ofA, piece)}; }
  PartMotion motionOf(bool ofA, const Piece& piece) const {
    if (found_.failed) return {};
    return motions_.of(ofA, piece);
  }

  void begin(const Piece& pieceA, const Piece& pieceB) {
    const Part a = part(true, pieceA);
    const Part b = part(false, pieceB);
    descend(a, b, motions_.approach(a.motion, b.motion), found_.result.hint);
  }

  void descend(const Part& a, const Part& b, const PieceApproach& approach, const Vector3d& guess) {
    if (a.piece.isLeaf() && b.piece.isLeaf()) {
      testLeaves(a.piece, b.piece, approach, guess);
      return;
    }
    WideNode room;
    const PiecePair::Split split = pieces_.split(a.piece, b.piece, room);
    const Part& other = split.ofA ? b : a;
    PiecePair::Bounds lower;
    BoxDirections directions;
    pieces_.boundChildren(split, other.piece, found_.settledBeyond(approach), lower,
                          approach ? &directions : nullptr);
    ++found_.result.iterations;
    std::array<int, WideNode::kLanes> order;
    const int open = sortOpen(*split.node, lower, found_.settledBeyond(approach), order);
    for (int i = 0; i < open; ++i) {
      const int lane = order[i];
      // The rest is farther.
      if (found_.inContact()) return found_.settle(std::max(0.0F, lower[lane]));
      if (lower[lane] > found_.settledBeyond(approach)) {
        found_.settle(lower[lane]);
        continue;
      }
      if (putOff(split, lane, other.piece, lower[lane])) continue;
      const Part child = part(split.ofA, PiecePair::child(split, lane));
      const Part &first = split.ofA ? child : other, &second = split.ofA ? other : child;
      const PieceApproach closer = motions_.approach(first.motion, second.motion);
      Vector3d direction = guess;
      if (closer) {
        const BoxGap gap =
            gapOf(child.piece, split.ofA, other.piece, lower[lane], directions.of(lane));
        if (settledAlong(gap, *closer, direction)) continue;
        if (settledByBody(child.piece, split.ofA, other.piece, found_.goalOfMotion(*closer),
                          direction))
          continue;
      }
      descend(first, second, closer, direction);
    }
  }

  /// A distance query tests the nearest of all pairs first: no other order tests fewer. Pairs that
  /// may overlap must be tested anyway. A motion bound gains nothing from the order.
  bool putOff(const PiecePair::Split& split, int lane, const Piece& other, float lower) {
    if (goal_.approach != nullptr || !(lower > 0.0F) || waiting_.isFull()) return false;
    const int place = PiecePair::placeOf(split, lane);
    waiting_.push({lower, split.ofA ? place : other.place, split.ofA ? other.place : place});
    return true;
  }

  /// The lanes that are not settled, nearest first.
  int sortOpen(const WideNode& node, const PiecePair::Bounds& lower, double beyond,
               std::array<int, WideNode::kLanes>& order) {
    int open = 0;
    for (int lane = 0; lane < node.count; ++lane) {
      if (lower[lane] > beyond) {
        found_.settle(lower[lane]);
        continue;
      }
      int at = open++;
      for (; at > 0 && lower[order[at - 1]] > lower[lane]; --at) order[at] = order[at - 1];
      order[at] = lane;
    }
    return open;
  }

  /// The gap along the direction of a bound, if the bound says that the boxes are apart.
  BoxGap gapOf(const Piece& child, bool ofA, const Piece& other, float lower,
               const Vector3d& along) const {
    return lower > 0.0F ? pieces_.gap(child, ofA, other, along) : BoxGap{};
  }

  /// Whether the boxes are as far apart as their motion needs. `direction` receives that of the
  /// gap, if there is one.
  bool settledAlong(const BoxGap& gap, const PartApproach& approach, Vector3d& direction) {
    if (!(gap.value > 0.0)) return false;
    direction = gap.direction;
    if (found_.failed || !(gap.value > approach.along(direction))) return false;
    found_.settle(gap.value);
    return true;
  }

  /// A node's box against a round body itself: against the body's own box, all of a mesh near a
  /// corner of that box would be tested triangle by triangle.
  bool settledByBody(const Piece& piece, bool ofA, const Piece& other, const Goal& goal,
                     const Vector3d& guess) {
    const Convex& body = (ofA ? b_ : a_).convex;
    if (piece.isLeaf() || !other.isWhole() || !PiecePair::hasCoarseBox(body)) return false;
    PiecePair::BoxAndBody pair;
    pieces_.place(piece, ofA, pair);
    const GjkResult found =
        convexPair(ofA ? pair.box : pair.body, ofA ? pair.body : pair.box, pair.a_from_b, guess,
                   goal, goal_.contact, goal_.tolerance, GjkMode::BoundOnly);
    found_.result.iterations += found.iterations;
    if (!found.satisfied) return false;
    found_.settle(found.lower);
    return true;
  }

  void testLeaves(const Piece& pieceA, const Piece& pieceB, const PieceApproach& approach,
                  const Vector3d& guess) {
    const GjkResult measured = pieces_.areTriangles(pieceA, pieceB) && !approach
                                   ? measureTriangles(pieceA, pieceB)
                                   : measure(pieceA, pieceB, approach, guess);
    found_.note(measured, approach);
  }

  /// For two leaves by GJK, along the direction that suits the goal.
  GjkResult measure(const Piece& pieceA, const Piece& pieceB, const PieceApproach& approach,
                    const Vector3d& guess) {
    PiecePair::Leaves leaves;
    pieces_.place(pieceA, pieceB, leaves);
    GjkResult measured =
        convexPair(leaves.a, leaves.b, leaves.a_from_b, guess, found_.goal(approach), goal_.contact,
                   goal_.tolerance, found_.mode());
    measured.pointA += leaves.centerA;
    measured.pointB += leaves.centerA;
    return measured;
  }

  /// For two triangles, if the direction does not matter.
  GjkResult measureTriangles(const Piece& pieceA, const Piece& pieceB) const {
    const double rounding = pieces_.rounding();
    const TriangleDistance found = triangleDistance(cornersOf(*a_.mesh, pieceA.primitive),
                                                    pieces_.movedCorners(pieceB.primitive),
                                                    found_.settledBeyond({}) + rounding);
    GjkResult measured;
    measured.iterations = 1;
    measured.lower = std::max(0.0, found.lower - rounding);
    measured.upper = found.upper;
    measured.pointA = found.pointA;
    measured.pointB = found.pointB;
    measured.satisfied = measured.lower > found_.settledBeyond({});
    return measured;
  }

  const Side& a_;
  const Side& b_;
  const PieceGoal& goal_;
  const PieceMotions& motions_;
  const PiecePair pieces_;
  PieceFindings& found_;
  WaitingPairs waiting_;
};

}  // namespace

std::optional<int> nearestPrimitive(const Side& side, const Vector3d& point) {
  if (side.isConvex()) return -1;
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  const Nearest near = side.mesh != nullptr
                           ? Nearest(side.mesh->vertices(), side.mesh->triangles(), *side.bvh)
                           : Nearest(side.cloud->points(), *side.bvh);
  const int primitive = near.find(point, kAnywhere).primitive;
  return primitive < 0 ? std::nullopt : std::optional(primitive);
}

void descendPieces(const Side& a, const Side& b, const Isometry3d& a_from_b,
                   const PieceMotions& motions, const std::optional<LikelyNearest>& first,
                   PieceFindings& found) {
  PieceDescent(a, b, a_from_b, motions, found).run(first);
}

}  // namespace swept::detail
