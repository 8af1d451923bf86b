// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/piecewise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <type_traits>

#include "narrowphase/cloud_enclosure.hpp"
#include "narrowphase/convex_pair.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Pairs of pieces put off, the nearest first. Of a fixed size: what finds no room is looked at
/// right away, in an order that is merely less good.
class Waiting {
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

class Search {
 public:
  Search(const Side& a, const Side& b, const Isometry3d& a_from_b, const PieceGoal& goal)
      : a_(a), b_(b), a_from_b_(a_from_b), goal_(goal) {
    if (goal.approach != nullptr) motions_.emplace(*goal.approach, a_from_b);
  }

  PieceResult run(const Vector3d& guess) {
    result_.hint = guess;
    if (hullsSuffice(guess)) return finish();
    if (!a_.isConvex() || !b_.isConvex()) {
      result_.lower = std::numeric_limits<double>::infinity();
      const PiecePair pieces(a_, b_, a_from_b_);
      pieces_ = &pieces;
      descend(part(true, pieces.rootA()), part(false, pieces.rootB()), result_.hint);
      while (!waiting_.isEmpty() && !inContact()) {
        const Waiting::Pair next = waiting_.pop();
        if (next.lower > settledBeyond({})) {
          settle(next.lower);
          break;
        }
        descend(part(true, pieces.piece(true, next.placeA)),
                part(false, pieces.piece(false, next.placeB)), result_.hint);
      }
      result_.normal.setZero();
    }
    return finish();
  }

 private:
  /// A piece and how it moves, in the search for a motion bound.
  struct Part {
    Piece piece;
    PartMotion motion;
  };

  Part part(bool ofA, const Piece& piece) const { return {piece, motionOf(ofA, piece)}; }

  PartMotion motionOf(bool ofA, const Piece& piece) const {
    if (!motions_ || failed_) return {};
    const bool flat = piece.isWhole() && (ofA ? a_ : b_).convex.isFlat();
    return flat ? motions_->ofBall(ofA) : motions_->of(ofA, piece.box);
  }

  /// The convex bodies or hulls themselves. For two convex bodies this is the whole answer.
  bool hullsSuffice(const Vector3d& guess) {
    const bool exact = a_.isConvex() && b_.isConvex();
    const PartMotion motionA = motionOf(true, PiecePair::rootOf(a_));
    const PartMotion motionB = motionOf(false, PiecePair::rootOf(b_));
    const Approach approach = approachOf(motionA, motionB);
    const GjkResult hulls = convexPair(a_.around(), b_.around(), a_from_b_, guess, goal(approach),
                                       goal_.contact, goal_.tolerance, modeOfLeaves());
    result_.iterations += hulls.iterations;
    result_.hint = hulls.normal;
    hullsApart_ = hulls.lower > 0.0;
    if (!exact && hulls.upper <= 0.0 && !goal_.surfaces && isInBoth(hulls.pointA)) {
      contactAt(hulls.pointA);
      return true;
    }
    if (!exact && !hulls.satisfied) return outOfReach(hulls);
    result_.lower = hulls.lower;
    result_.normal = hulls.lower > 0.0 ? hulls.normal : Vector3d::Zero();
    if (!exact) return true;  // the nearest points of hulls witness nothing of what they contain
    result_.upper = hulls.upper;
    result_.pointA = hulls.pointA;
    result_.pointB = hulls.pointB;
    if (!hulls.satisfied) failed_ = true;
    return true;
  }

  /// A point that both hulls have is in both meshes, too, unless it lies in a dent.
  bool isInBoth(const Vector3d& pointInA) const {
    const auto has = [](const Side& side, const Vector3d& point) {
      if (side.isConvex()) return true;
      return side.mesh != nullptr && side.mesh->encloses(point);
    };
    return has(a_, pointInA) && has(b_, a_from_b_.inverse() * pointInA);
  }

  /// Hulls that are apart, but by less than the motion needs even if the meshes lie deep inside
  /// them: the pieces will not do better, and there is no contact.
  bool outOfReach(const GjkResult& hulls) {
    if (goal_.approach == nullptr || goal_.thorough || !(hulls.lower > goal_.contact)) return false;
    if (hulls.upper + a_.dent + b_.dent > goal_.approach->along(hulls.normal)) return false;
    failed_ = true;
    result_.lower = hulls.lower;
    return true;
  }

  GjkMode modeOfLeaves() const {
    return goal_.approach != nullptr ? GjkMode::GoalOnly : GjkMode::Exact;
  }

  PieceResult finish() {
    if (!inContact() && !hullsApart_ && !goal_.surfaces) lookForEnclosure();
    result_.lower = std::min(result_.lower, result_.upper);
    result_.satisfied = !failed_ && !inContact();
    return result_;
  }

  bool inContact() const { return result_.upper <= goal_.contact; }

  /// None in a distance query.
  using Approach = std::optional<PartApproach>;
  Approach approachOf(const PartMotion& a, const PartMotion& b) const {
    if (goal_.approach == nullptr) return std::nullopt;
    return PartApproach(*goal_.approach, a, b);
  }

  /// What a pair of pieces has to exceed to be settled. Once some pair has failed a motion bound,
  /// only contact is still of interest; in a distance query, only what is nearer than the best so
  /// far.
  Goal goal(const Approach& approach) const {
    if (approach) return failed_ ? Goal(goal_.contact) : Goal(*approach);
    return Goal(std::min(goal_.enough, std::max(0.0, result_.upper - goal_.tolerance)));
  }

  /// Of two leaves by GJK, along the direction that suits the goal.
  GjkResult measure(const Piece& pieceA, const Piece& pieceB, const Approach& approach,
                    const Vector3d& guess) {
    PiecePair::Leaves leaves;
    pieces_->place(pieceA, pieceB, leaves);
    GjkResult measured = convexPair(leaves.a, leaves.b, leaves.a_from_b, guess, goal(approach),
                                    goal_.contact, goal_.tolerance, modeOfLeaves());
    measured.pointA += leaves.centerA;
    measured.pointB += leaves.centerA;
    return measured;
  }

  /// Of two triangles, where the direction does not matter.
  GjkResult measureTriangles(const Piece& pieceA, const Piece& pieceB) const {
    const double rounding = pieces_->rounding();
    const TriangleDistance found =
        triangleDistance(cornersOf(*a_.mesh, pieceA.primitive),
                         pieces_->movedCorners(pieceB.primitive), settledBeyond({}) + rounding);
    GjkResult measured;
    measured.iterations = 1;
    measured.lower = std::max(0.0, found.lower - rounding);
    measured.upper = found.upper;
    measured.pointA = found.pointA;
    measured.pointB = found.pointB;
    measured.satisfied = measured.lower > settledBeyond({});
    return measured;
  }

  void descend(const Part& a, const Part& b, const Vector3d& guess) {
    const Approach approach = approachOf(a.motion, b.motion);
    if (a.piece.isLeaf() && b.piece.isLeaf()) {
      testLeaves(a.piece, b.piece, approach, guess);
      return;
    }
    const PiecePair::Split split = pieces_->split(a.piece, b.piece);
    const Part& other = split.ofA ? b : a;
    PiecePair::Bounds lower;
    pieces_->boundChildren(split, other.piece, settledBeyond(approach), lower);
    ++result_.iterations;
    std::array<int, WideNode::kLanes> order;
    const int open = sortOpen(*split.node, lower, settledBeyond(approach), order);
    for (int i = 0; i < open; ++i) {
      if (inContact()) return;
      const int lane = order[i];
      if (lower[lane] > settledBeyond(approach)) {
        settle(lower[lane]);
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
        settle(lower[lane]);
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
    if (!failed_ && lower > approach.most()) {
      settle(lower);
      return true;
    }
    const BoxGap gap = lower > 0.0 ? pieces_->gap(part.piece, ofA, other.piece) : BoxGap{};
    if (gap.value > 0.0) {
      direction = gap.direction;
      if (!failed_ && gap.value > approach.along(direction)) {
        settle(gap.value);
        return true;
      }
    }
    return settledByBody(part.piece, ofA, other.piece,
                         failed_ ? Goal(goal_.contact) : Goal(approach), direction);
  }

  /// A node's box against a round body itself: against the body's own box alone, all of a mesh that
  /// is near a corner of that box would be looked at triangle by triangle.
  bool settledByBody(const Piece& piece, bool ofA, const Piece& other, const Goal& goal,
                     const Vector3d& guess) {
    if (piece.isLeaf() || !other.isWhole() || !PiecePair::isRound((ofA ? b_ : a_).convex))
      return false;
    PiecePair::BoxAndBody pair;
    pieces_->place(piece, ofA, pair);
    const GjkResult found =
        convexPair(ofA ? pair.box : pair.body, ofA ? pair.body : pair.box, pair.a_from_b, guess,
                   goal, goal_.contact, goal_.tolerance, GjkMode::BoundOnly);
    result_.iterations += found.iterations;
    if (!found.satisfied) return false;
    settle(found.lower);
    return true;
  }

  void settle(double lower) { result_.lower = std::min(result_.lower, lower); }

  /// m. A proven distance beyond this settles a pair whatever the direction: the goal may have come
  /// closer since the pair was measured.
  double settledBeyond(const Approach& approach) const {
    if (approach) return failed_ ? goal_.contact : approach->most();
    return std::min(goal_.enough, std::max(0.0, result_.upper - goal_.tolerance));
  }

  void testLeaves(const Piece& pieceA, const Piece& pieceB, const Approach& approach,
                  const Vector3d& guess) {
    const GjkResult measured = pieces_->areTriangles(pieceA, pieceB) && !approach
                                   ? measureTriangles(pieceA, pieceB)
                                   : measure(pieceA, pieceB, approach, guess);
    result_.iterations += measured.iterations;
    settle(measured.lower);
    if (measured.upper < result_.upper) {
      result_.upper = measured.upper;
      result_.pointA = measured.pointA;
      result_.pointB = measured.pointB;
    }
    if (!measured.satisfied && !inContact() && !(measured.lower > settledBeyond(approach))) {
      failed_ = true;
      if (!measured.normal.isZero()) result_.hint = measured.normal;
    }
  }

  void contactAt(const Vector3d& pointInA) {
    result_.upper = 0.0;
    result_.lower = 0.0;
    result_.pointA = pointInA;
    result_.pointB = pointInA;
  }

  /// Surfaces that do not meet can still be one inside the other. A convex body lies wholly on one
  /// side of the mesh's surface then, and so does each connected component of a mesh and each ball
  /// of a cloud: one point of each tells.
  void lookForEnclosure() {
    if (a_.mesh != nullptr && b_.cloud != nullptr) {
      const auto point = enclosedPoint(*a_.mesh, *b_.cloud, a_from_b_);
      if (point) contactAt(a_from_b_ * *point);
      return;
    }
    if (a_.cloud != nullptr && b_.mesh != nullptr) {
      const auto point = enclosedPoint(*b_.mesh, *a_.cloud, a_from_b_.inverse());
      if (point) contactAt(*point);
      return;
    }
    if (a_.mesh != nullptr) {
      for (const Vector3d& point : representatives(b_)) {
        const Vector3d inA = a_from_b_ * point;
        if (a_.mesh->encloses(inA)) return contactAt(inA);
      }
    }
    if (b_.mesh != nullptr) {
      const Isometry3d b_from_a = a_from_b_.inverse();
      for (const Vector3d& point : representatives(a_)) {
        if (b_.mesh->encloses(b_from_a * point)) return contactAt(point);
      }
    }
  }

  std::span<const Vector3d> representatives(const Side& side) {
    if (side.mesh != nullptr) return side.mesh->componentPoints();
    ownPoint_ = side.convex.support(Vector3d::UnitX());
    return {&ownPoint_, 1};
  }

  const Side& a_;
  const Side& b_;
  const Isometry3d& a_from_b_;
  const PieceGoal& goal_;
  std::optional<PartMotions> motions_;  ///< where a motion bound is asked for
  const PiecePair* pieces_ = nullptr;   ///< null while only convex bodies are looked at
  Vector3d ownPoint_ = Vector3d::Zero();
  PieceResult result_;
  Waiting waiting_;
  bool failed_ = false;
  bool hullsApart_ = false;  ///< proven: no enclosure either
};

}  // namespace

PieceResult searchPieces(const Side& a, const Side& b, const Isometry3d& a_from_b,
                         const Vector3d& guess, const PieceGoal& goal) {
  return Search(a, b, a_from_b, goal).run(guess);
}

}  // namespace swept::detail
