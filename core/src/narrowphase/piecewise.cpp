// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/piecewise.hpp"

#include <algorithm>
#include <optional>

#include "narrowphase/convex_pair.hpp"
#include "narrowphase/enclosure.hpp"
#include "narrowphase/part_pairs.hpp"
#include "narrowphase/piece_descent.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// A pair of bodies with pieces; the convex bodies around them are tested first.
class Search {
 public:
  Search(const Side& a, const Side& b, const Isometry3d& a_from_b, const PieceGoal& goal)
      : a_(a),
        b_(b),
        a_from_b_(a_from_b),
        goal_(goal),
        motions_(a, b, a_from_b, goal.approach),
        found_(goal) {}

  PieceResult run(const Vector3d& guess) {
    found_.result.hint = guess;
    std::optional<LikelyNearest> first;
    if (!hullsSuffice(guess) && !partsSuffice() && !nearestOfHulls(first)) {
      found_.result.lower = std::numeric_limits<double>::infinity();
      found_.result.normal.setZero();
      descendPieces(a_, b_, a_from_b_, motions_, first, found_);
    }
    // Surfaces that do not meet can still be one inside the other.
    const bool meet = found_.inContact() && !(found_.result.lower > 0.0);
    if (!meet && !hullsApart_ && !goal_.surfaces) {
      const auto enclosed = enclosedPoint(a_, b_, a_from_b_);
      if (enclosed) found_.noteContact(*enclosed);
    }
    found_.settle(found_.result.upper);
    found_.result.satisfied = !found_.failed && !found_.inContact();
    return found_.result;
  }

 private:
  /// The convex bodies or hulls themselves. For two convex bodies this is the whole answer.
  bool hullsSuffice(const Vector3d& guess) {
    const bool exact = a_.isConvex() && b_.isConvex();
    const PartMotion motionA = motions_.of(true, PiecePair::rootOf(a_));
    const PartMotion motionB = motions_.of(false, PiecePair::rootOf(b_));
    const PieceApproach approach = motions_.approach(motionA, motionB);
    const GjkResult hulls =
        convexPair(a_.around(), b_.around(), a_from_b_, guess, found_.goal(approach), goal_.contact,
                   goal_.tolerance, found_.mode());
    PieceResult& result = found_.result;
    result.iterations += hulls.iterations;
    result.hint = hulls.normal;
    hullsApart_ = hulls.lower > 0.0;
    if (!exact && hulls.upper <= 0.0 && !goal_.surfaces &&
        isInBoth(a_, b_, a_from_b_, hulls.pointA)) {
      found_.noteContact(hulls.pointA);
      return true;
    }
    if (!exact && !hulls.satisfied) return outOfReach(hulls);
    result.lower = hulls.lower;
    result.normal = hulls.lower > 0.0 ? hulls.normal : Vector3d::Zero();
    if (!exact) return true;  // the nearest points of hulls are no witnesses for their contents
    result.upper = hulls.upper;
    result.pointA = hulls.pointA;
    result.pointB = hulls.pointB;
    found_.failed = !hulls.satisfied;
    return true;
  }

  /// The parts around meshes, for motions. Two convex bodies have none, and need none.
  bool partsSuffice() {
    if (a_.isConvex() && b_.isConvex()) return true;
    if (goal_.approach == nullptr || (a_.parts == nullptr && b_.parts == nullptr)) return false;
    switch (compareParts(a_, b_, a_from_b_, motions_, found_)) {
      case PartsAnswer::Open:
        return false;
      case PartsAnswer::OutOfReach:
        found_.failed = true;
        break;
      case PartsAnswer::Apart:
        break;
    }
    hullsApart_ = true;
    return true;
  }

  /// A distance query ends at once if the hulls are far enough apart. Otherwise `first` receives
  /// the pieces at the nearest points of the hulls. They are the nearest pieces where the bodies
  /// reach these points, as bodies that are convex but for a few dents mostly do.
  bool nearestOfHulls(std::optional<LikelyNearest>& first) {
    if (goal_.approach != nullptr) return false;
    // Points whose distance is right up to e can be off by much more, the root of e, across the
    // normal, and so on another piece. Hulls of corners lose nothing by this: their search ends
    // with the right corners.
    constexpr double kShare = 1e-3;
    const GjkResult hulls =
        convexPair(a_.convex, b_.convex, a_from_b_, found_.result.hint, Goal(goal_.enough),
                   goal_.contact, kShare * goal_.tolerance, GjkMode::Exact);
    PieceResult& result = found_.result;
    result.iterations += hulls.iterations;
    hullsApart_ = hullsApart_ || hulls.lower > 0.0;
    if (hulls.satisfied) {
      result.lower = hulls.lower;
      result.normal = hulls.normal;
      return true;
    }
    // Hulls that overlap, or numbers that are not finite, have no such points.
    if (!(hulls.upper < std::numeric_limits<double>::infinity())) return false;
    const std::optional<int> nearA = nearestPrimitive(a_, hulls.pointA);
    const std::optional<int> nearB = nearestPrimitive(b_, a_from_b_.inverse() * hulls.pointB);
    if (nearA && nearB) first = {*nearA, *nearB, hulls.lower, hulls.normal};
    return false;
  }

  /// Hulls that are apart, but by less than the motion needs even if the meshes lie deep inside
  /// them: the pieces will not do better, and there is no contact.
  bool outOfReach(const GjkResult& hulls) {
    if (goal_.approach == nullptr || goal_.thorough || !(hulls.lower > goal_.contact)) return false;
    if (hulls.upper + a_.concavity + b_.concavity > goal_.approach->along(hulls.normal))
      return false;
    found_.failed = true;
    found_.result.lower = hulls.lower;
    return true;
  }

  const Side& a_;
  const Side& b_;
  const Isometry3d& a_from_b_;
  const PieceGoal& goal_;
  const PieceMotions motions_;
  PieceFindings found_;
  bool hullsApart_ = false;  ///< proven: no enclosure either
};

}  // namespace

PieceResult searchPieces(const Side& a, const Side& b, const Isometry3d& a_from_b,
                         const Vector3d& guess, const PieceGoal& goal) {
  return Search(a, b, a_from_b, goal).run(guess);
}

}  // namespace swept::detail
