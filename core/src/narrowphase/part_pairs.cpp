// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/part_pairs.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "bvh/box_bounds.hpp"
#include "bvh/box_fit.hpp"
#include "narrowphase/convex_pair.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Most pairs of parts that are compared by GJK: beyond it they are so near that the pieces know
/// better.
constexpr int kMostCompared = 64;

/// A part, or the convex body around a whole side, as they move.
struct Part {
  Convex body;
  Piece box;  ///< of the body's core
  PartMotion motion;
  double grown = 0.0;      ///< m. How far the body reaches beyond its core
  double concavity = 0.0;  ///< m, see EnclosingParts
  int children = -1;       ///< node of the side's parts
};

class PartPairs {
 public:
  PartPairs(const Side& a, const Side& b, const Isometry3d& a_from_b, const PieceMotions& motions,
            PieceFindings& found)
      : a_(a),
        b_(b),
        a_from_b_(a_from_b),
        motions_(motions),
        found_(found),
        frames_(a_from_b, PiecePair::reachOf(a) + PiecePair::reachOf(b)),
        back_(frames_.inverse()) {}

  PartsAnswer run() {
    const bool flat = a_.convex.isFlat() || b_.convex.isFlat();
    if (flat || !frames_.usable() || !divide(whole(true), whole(false))) return PartsAnswer::Open;
    found_.settle(least_);
    found_.result.normal.setZero();
    return tooNear_ ? PartsAnswer::OutOfReach : PartsAnswer::Apart;
  }

 private:
  const Side& side(bool ofA) const { return ofA ? a_ : b_; }

  Part whole(bool ofA) const {
    const Side& own = side(ofA);
    Part part;
    part.body = own.around();
    part.box = PiecePair::rootOf(own);
    part.motion = motions_.of(ofA, part.box);
    part.grown = part.body.radius + part.body.error;
    part.concavity = own.concavity;
    part.children = own.parts != nullptr ? 0 : -1;
    return part;
  }

  Part child(bool ofA, const EnclosingParts::Node& node, int lane) const {
    const EnclosingParts::Part& own = node.parts[static_cast<std::size_t>(lane)];
    Part part;
    part.body = Convex::of(own.hull);
    part.body.radius = part.grown = own.radius;
    part.body.error = part.body.omitted = 0.0;
    part.box.box = node.boxes.box(lane);
    part.motion = motions_.of(ofA, part.box);
    part.concavity = own.concavity;
    part.children = own.children;
    return part;
  }

  /// Compares the children of the part that is farther from its mesh with the other. False: the
  /// pieces may know more.
  bool divide(const Part& a, const Part& b) {
    if (a.children < 0 && b.children < 0) return false;
    const bool ofA = b.children < 0 || (a.children >= 0 && a.concavity >= b.concavity);
    const Part& other = ofA ? b : a;
    const EnclosingParts::Node& node =
        side(ofA).parts->nodes[static_cast<std::size_t>((ofA ? a : b).children)];
    double grown = 0.0;
    for (const EnclosingParts::Part& part : node.parts) grown = std::max(grown, part.radius);
    const double most = found_.asked.approach->most() + grown + other.grown;
    std::array<float, WideNode::kLanes> lower;
    BoxDirections directions;
    boxLowerBounds(node.boxes, ofA ? frames_ : back_, other.box.box, aboveInSingle(most), lower,
                   directions);
    for (int lane = 0; lane < node.boxes.count; ++lane) {
      const double apart = static_cast<double>(lower[lane]) - grown - other.grown;
      if (settled(apart, found_.asked.approach->most())) continue;
      const Part part = child(ofA, node, lane);
      const Part &first = ofA ? part : other, &second = ofA ? other : part;
      const PartApproach approach(*found_.asked.approach, first.motion, second.motion);
      Vector3d guess = found_.result.hint;
      if (lower[lane] > 0.0F) {
        const BoxGap gap =
            boxGap(part.box.box, ofA ? frames_ : back_, other.box.box, directions.of(lane));
        guess = ofA ? gap.direction : Vector3d(-(a_from_b_.linear() * gap.direction));
        if (settled(gap.value - part.grown - other.grown, approach.along(guess))) continue;
      }
      if (!compare(first, second, approach, guess) && !divide(first, second)) return false;
    }
    return true;
  }

  bool settled(double apart, double goal) {
    if (!(apart > (tooNear_ ? found_.asked.contact : goal))) return false;
    least_ = std::min(least_, apart);
    return true;
  }

  /// False: their children may know more.
  bool compare(const Part& a, const Part& b, const PartApproach& approach, const Vector3d& guess) {
    if (++compared_ > kMostCompared) return false;
    const double contact = found_.asked.contact;
    const GjkResult apart =
        convexPair(a.body, b.body, a_from_b_, guess, tooNear_ ? Goal(contact) : Goal(approach),
                   contact, found_.asked.tolerance, GjkMode::GoalOnly);
    found_.result.iterations += apart.iterations;
    if (!apart.satisfied) {
      if (tooNear_ || found_.asked.thorough || !(apart.lower > contact)) return false;
      if (apart.upper + a.concavity + b.concavity > approach.along(apart.normal)) return false;
      tooNear_ = true;
      found_.result.hint = apart.normal;
    }
    least_ = std::min(least_, apart.lower);
    return true;
  }

  const Side& a_;
  const Side& b_;
  const Isometry3d& a_from_b_;
  const PieceMotions& motions_;
  PieceFindings& found_;
  const BoxFrames frames_;
  const BoxFrames back_;
  double least_ = std::numeric_limits<double>::infinity();  ///< m
  int compared_ = 0;
  bool tooNear_ = false;
};

}  // namespace

PartsAnswer compareParts(const Side& a, const Side& b, const Isometry3d& a_from_b,
                         const PieceMotions& motions, PieceFindings& found) {
  return PartPairs(a, b, a_from_b, motions, found).run();
}

}  // namespace swept::detail
