// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/piece_descent.hpp"

#include <algorithm>
#include <array>

#include "narrowphase/convex_pair.hpp"
#include "narrowphase/waiting_pairs.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

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

  void run() {
    descend(part(true, pieces_.rootA()), part(false, pieces_.rootB()), found_.result.hint);
    while (!waiting_.isEmpty() && !found_.inContact()) {
      const WaitingPairs::Pair next = waiting_.pop();
      if (next.lower > found_.settledBeyond({})) return found_.settle(next.lower);
      descend(part(true, pieces_.piece(true, next.placeA)),
              part(false, pieces_.piece(false, next.placeB)), found_.result.hint);
    }
  }

 private:
  /// A piece and how it moves, where that is still of interest.
  struct Part {
    Piece piece;
    PartMotion motion;
  };
  Part part(bool ofA, const Piece& piece) const { return {piece, motionOf(ofA, piece)}; }
  PartMotion motionOf(bool ofA, const Piece& piece) const {
    if (found_.failed) return {};
    return motions_.of(ofA, piece);
  }

  void descend(const Part& a, const Part& b, const Vector3d& guess) {
    const PieceApproach approach = motions_.approach(a.motion, b.motion);
    if (a.piece.isLeaf() && b.piece.isLeaf()) {
      testLeaves(a.piece, b.piece, approach, guess);
      return;
    }
    WideNode room;
    const PiecePair::Split split = pieces_.split(a.piece, b.piece, room);
    const Part& other = split.ofA ? b : a;
    PiecePair::Bounds lower;
    pieces_.boundChildren(split, other.piece, found_.settledBeyond(approach), lower);
    ++found_.result.iterations;
    std::array<int, WideNode::kLanes> order;
    const int open = sortOpen(*split.node, lower, found_.settledBeyond(approach), order);
    for (int i = 0; i < open; ++i) {
      if (found_.inContact()) return;
      const int lane = order[i];
      if (lower[lane] > found_.settledBeyond(approach)) {
        found_.settle(lower[lane]);
        continue;
      }
      if (putOff(split, lane, other.piece, lower[lane])) continue;
      const Part child = part(split.ofA, PiecePair::child(split, lane));
      Vector3d direction = guess;
      if (settledAlong(child, split.ofA, other, lower[lane], direction)) continue;
      if (split.ofA) {
        descend(child, other, direction);
      } else {
        descend(other, child, direction);
      }
    }
  }

  /// A distance query looks at the nearest of all pairs first: no other order looks at fewer. Pairs
  /// that may overlap have to be looked at anyway. A motion bound gains nothing from the order.
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

  /// Whether the boxes are apart as their motion needs in any direction, or along the best of their
  /// own axes. `direction` receives that axis, from a to b.
  bool settledAlong(const Part& part, bool ofA, const Part& other, double lower,
                    Vector3d& direction) {
    if (goal_.approach == nullptr) return false;
    const PartApproach approach(*goal_.approach, (ofA ? part : other).motion,
                                (ofA ? other : part).motion);
    if (!found_.failed && lower > approach.most()) {
      found_.settle(lower);
      return true;
    }
    const BoxGap gap = lower > 0.0 ? pieces_.gap(part.piece, ofA, other.piece) : BoxGap{};
    if (gap.value > 0.0) {
      direction = gap.direction;
      if (!found_.failed && gap.value > approach.along(direction)) {
        found_.settle(gap.value);
        return true;
      }
    }
    return settledByBody(part.piece, ofA, other.piece, found_.goalOfMotion(approach), direction);
  }

  /// A node's box against a round body itself: against the body's own box alone, all of a mesh that
  /// is near a corner of that box would be looked at triangle by triangle.
  bool settledByBody(const Piece& piece, bool ofA, const Piece& other, const Goal& goal,
                     const Vector3d& guess) {
    if (piece.isLeaf() || !other.isWhole() || !PiecePair::isRound((ofA ? b_ : a_).convex))
      return false;
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

  /// Of two leaves by GJK, along the direction that suits the goal.
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

  /// Of two triangles, where the direction does not matter.
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

void descendPieces(const Side& a, const Side& b, const Isometry3d& a_from_b,
                   const PieceMotions& motions, PieceFindings& found) {
  PieceDescent(a, b, a_from_b, motions, found).run();
}

}  // namespace swept::detail
