// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/piecewise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "bvh/triangle_bvh.hpp"
#include "narrowphase/gjk.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Beyond this many hull vertices the scan for a support point costs more than the hierarchy.
constexpr std::size_t kCheapHull = 400;

/// A piece of a side: a node of its hierarchy, a triangle, or the whole convex body.
struct Piece {
  int node = -1;      ///< of the mesh's hierarchy
  int triangle = -1;  ///< of the mesh; takes precedence over `node`
};

class Search {
 public:
  Search(const Side& a, const Side& b, const Isometry3d& a_from_b, const PieceGoal& goal)
      : a_(a), b_(b), a_from_b_(a_from_b), goal_(goal) {}

  PieceResult run(const Vector3d& guess) {
    result_.hint = guess;
    if (hullsSuffice(guess)) return finish();
    if (a_.mesh != nullptr || b_.mesh != nullptr) {
      result_.lower = std::numeric_limits<double>::infinity();
      const Piece rootA{a_.mesh ? 0 : -1, -1};
      const Piece rootB{b_.mesh ? 0 : -1, -1};
      descend(rootA, rootB, result_.hint);
      result_.normal.setZero();
    }
    return finish();
  }

 private:
  /// The convex bodies or hulls themselves. For two convex bodies this is the whole answer.
  bool hullsSuffice(const Vector3d& guess) {
    const bool exact = a_.mesh == nullptr && b_.mesh == nullptr;
    if (!exact && !(a_.convexIsCheap && b_.convexIsCheap)) return false;
    const GjkResult hulls = gjk(a_.convex, b_.convex, a_from_b_, guess, goal(), goal_.contact,
                                goal_.tolerance, modeOfLeaves());
    result_.iterations += hulls.iterations;
    result_.hint = hulls.normal;
    hullsApart_ = hulls.lower > 0.0;
    if (!exact && !hulls.satisfied) return outOfReach(hulls);
    result_.lower = hulls.lower;
    result_.upper = hulls.upper;
    result_.pointA = hulls.pointA;
    result_.pointB = hulls.pointB;
    result_.normal = hulls.lower > 0.0 ? hulls.normal : Vector3d::Zero();
    if (!hulls.satisfied) failed_ = true;
    return true;
  }

  /// Hulls that are apart, but by less than the motion needs even if the meshes lie deep inside them: the
  /// pieces will not do better, and there is no contact.
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
    if (!inContact() && !hullsApart_) lookForEnclosure();
    result_.lower = std::min(result_.lower, result_.upper);
    result_.satisfied = !failed_ && !inContact();
    return result_;
  }

  bool inContact() const { return result_.upper <= goal_.contact; }

  /// What a pair of pieces has to exceed to be settled. Once some pair has failed a motion bound,
  /// only contact is still of interest; in a distance query, only what is nearer than the best so
  /// far.
  Goal goal() const {
    if (goal_.approach != nullptr) {
      return failed_ ? Goal(goal_.contact) : Goal(*goal_.approach);
    }
    return Goal(std::min(goal_.enough, std::max(0.0, result_.upper - goal_.tolerance)));
  }

  struct Placed {
    Convex body;
    Vector3d center = Vector3d::Zero();  ///< of `body`, in its side's frame
  };

  Placed place(const Side& side, const Piece& piece, std::array<Vector3d, 3>& corners) const {
    Placed placed;
    if (side.mesh == nullptr) {
      placed.body = side.convex;
    } else if (piece.triangle >= 0) {
      const Eigen::Vector3i& t = side.mesh->triangles()[piece.triangle];
      placed.center = side.mesh->vertices()[t[0]];
      for (int i = 0; i < 3; ++i) corners[i] = side.mesh->vertices()[t[i]] - placed.center;
      placed.body = Convex::ofPoints(corners);
    } else {
      const TriangleBvh::Node& node = side.mesh->bvh().nodes()[piece.node];
      placed.body = Convex::of(Box{node.halfExtents});
      placed.center = node.center;
    }
    return placed;
  }

  GjkResult measure(const Piece& pieceA, const Piece& pieceB, const Vector3d& guess, bool leaves) {
    std::array<Vector3d, 3> cornersA;
    std::array<Vector3d, 3> cornersB;
    const Placed a = place(a_, pieceA, cornersA);
    const Placed b = place(b_, pieceB, cornersB);
    Isometry3d pose = a_from_b_;
    pose.translation() = a_from_b_ * b.center - a.center;
    // What boxes are apart by exactly does not matter: they only order and prune the search.
    const double accuracy = leaves ? goal_.tolerance : 0.05 * (a.body.extent + b.body.extent);
    const GjkMode mode = leaves ? modeOfLeaves() : GjkMode::BoundOnly;
    GjkResult measured = gjk(a.body, b.body, pose, guess, goal(), goal_.contact, accuracy, mode);
    measured.pointA += a.center;
    measured.pointB += a.center;
    result_.iterations += measured.iterations;
    return measured;
  }

  void settle(const GjkResult& measured) {
    result_.lower = std::min(result_.lower, measured.lower);
  }

  bool isLeaf(const Side& side, const Piece& piece) const {
    return side.mesh == nullptr || side.mesh->bvh().nodes()[piece.node].rightChild < 0;
  }

  double sizeOf(const Side& side, const Piece& piece) const {
    return isLeaf(side, piece) ? -1.0
                               : side.mesh->bvh().nodes()[piece.node].halfExtents.squaredNorm();
  }

  void descend(const Piece& pieceA, const Piece& pieceB, const Vector3d& guess) {
    const double sizeA = sizeOf(a_, pieceA);
    const double sizeB = sizeOf(b_, pieceB);
    if (sizeA < 0.0 && sizeB < 0.0) {
      testLeaves(pieceA, pieceB, guess);
      return;
    }
    const bool splitA = sizeA >= sizeB;
    const Side& side = splitA ? a_ : b_;
    const int node = splitA ? pieceA.node : pieceB.node;
    const std::array<Piece, 2> children{Piece{node + 1, -1},
                                        Piece{side.mesh->bvh().nodes()[node].rightChild, -1}};
    std::array<GjkResult, 2> bounds;
    for (int i = 0; i < 2; ++i) {
      bounds[i] = splitA ? measure(children[i], pieceB, guess, false)
                         : measure(pieceA, children[i], guess, false);
    }
    const int first = bounds[0].lower <= bounds[1].lower ? 0 : 1;
    for (const int i : {first, 1 - first}) {
      if (inContact()) return;
      if (bounds[i].satisfied || bounds[i].lower > settledBeyond()) {
        settle(bounds[i]);
        continue;
      }
      if (splitA) {
        descend(children[i], pieceB, bounds[i].normal);
      } else {
        descend(pieceA, children[i], bounds[i].normal);
      }
    }
  }

  /// m. A proven distance beyond this settles a pair whatever the direction: the goal may have come
  /// closer since the pair was measured.
  double settledBeyond() const {
    if (goal_.approach != nullptr) return failed_ ? goal_.contact : goal_.approach->most();
    return std::min(goal_.enough, std::max(0.0, result_.upper - goal_.tolerance));
  }

  void testLeaves(const Piece& pieceA, const Piece& pieceB, const Vector3d& guess) {
    const auto [firstA, countA] = trianglesOf(a_, pieceA);
    const auto [firstB, countB] = trianglesOf(b_, pieceB);
    for (int i = 0; i < countA; ++i) {
      for (int j = 0; j < countB; ++j) {
        const GjkResult measured = measure({pieceA.node, a_.mesh ? firstA + i : -1},
                                           {pieceB.node, b_.mesh ? firstB + j : -1}, guess, true);
        settle(measured);
        if (measured.upper < result_.upper) {
          result_.upper = measured.upper;
          result_.pointA = measured.pointA;
          result_.pointB = measured.pointB;
        }
        if (inContact()) return;
        if (!measured.satisfied && !(measured.lower > settledBeyond())) {
          failed_ = true;
          if (!measured.normal.isZero()) result_.hint = measured.normal;
        }
      }
    }
  }

  std::array<int, 2> trianglesOf(const Side& side, const Piece& piece) const {
    if (side.mesh == nullptr) return {0, 1};
    const TriangleBvh::Node& node = side.mesh->bvh().nodes()[piece.node];
    return {node.firstTriangle, node.triangleCount};
  }

  void contactAt(const Vector3d& pointInA) {
    result_.upper = 0.0;
    result_.lower = 0.0;
    result_.pointA = pointInA;
    result_.pointB = pointInA;
  }

  /// Surfaces that do not meet can still be one inside the other. A convex body lies wholly on one
  /// side of the mesh's surface then, and so does each connected component of a mesh: one point
  /// tells.
  void lookForEnclosure() {
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
  Vector3d ownPoint_ = Vector3d::Zero();
  PieceResult result_;
  bool failed_ = false;
  bool hullsApart_ = false;  ///< proven: no enclosure either
};

}  // namespace

Side Side::of(const Shape& shape) {
  return std::visit(
      [](const auto& body) -> Side {
        if constexpr (std::is_same_v<decltype(body), const TriangleMesh&>) {
          const ConvexHull& hull = body.hull();
          return {&body, Convex::of(hull), hull.vertices().size() <= kCheapHull, body.dent()};
        } else {
          return {nullptr, Convex::of(body), true, 0.0};
        }
      },
      shape);
}

PieceResult searchPieces(const Side& a, const Side& b, const Isometry3d& a_from_b,
                         const Vector3d& guess, const PieceGoal& goal) {
  return Search(a, b, a_from_b, goal).run(guess);
}

}  // namespace swept::detail
