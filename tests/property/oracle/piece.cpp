// SPDX-License-Identifier: BSD-3-Clause
#include "piece.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oracle {
namespace {

/// Leaves of two trees (one node for a primitive) whose boxes come within a margin of each other.
/// `visit` gets the leaves' nodes and returns true to stop.
template <class Visit, class Margin>
class PairWalk {
 public:
  PairWalk(const Piece& a, const Piece& b, const Isometry3d& a_from_b, Visit visit, Margin margin)
      : a_(a), b_(b), filter_(a_from_b), a_from_b_(a_from_b), visit_(visit), margin_(margin) {}

  bool walk(int i, int k) {
    const Mesh::Node* p = a_.mesh ? &a_.mesh->nodes()[i] : nullptr;
    const Mesh::Node* q = b_.mesh ? &b_.mesh->nodes()[k] : nullptr;
    const Vector3d& cp = p ? p->center : a_.boxCenter;
    const Vector3d& hp = p ? p->half : a_.boxHalf;
    const Vector3d& cq = q ? q->center : b_.boxCenter;
    const Vector3d& hq = q ? q->half : b_.boxHalf;
    if (!filter_.near(cp, hp, cq, hq, margin_())) return false;
    const bool innerP = p && p->left >= 0, innerQ = q && q->left >= 0;
    if (!innerP && !innerQ) return visit_(p, q);
    if (innerP && (!innerQ || hp.squaredNorm() >= hq.squaredNorm())) {
      const Vector3d target = a_from_b_ * cq;
      const auto [first, second] = nearerFirst(*a_.mesh, *p, target);
      return walk(first, k) || walk(second, k);
    }
    const Vector3d target = a_from_b_.inverse(Eigen::Isometry) * cp;
    const auto [first, second] = nearerFirst(*b_.mesh, *q, target);
    return walk(i, first) || walk(i, second);
  }

 private:
  static std::pair<int, int> nearerFirst(const Mesh& mesh, const Mesh::Node& node,
                                         const Vector3d& target) {
    const double left = (mesh.nodes()[node.left].center - target).squaredNorm();
    const double right = (mesh.nodes()[node.right].center - target).squaredNorm();
    return left <= right ? std::pair(node.left, node.right) : std::pair(node.right, node.left);
  }

  const Piece& a_;
  const Piece& b_;
  BoxFilter filter_;
  Isometry3d a_from_b_;
  Visit visit_;
  Margin margin_;
};

template <class Visit, class Margin>
bool forLeaves(const Piece& a, const Piece& b, const Isometry3d& a_from_b, Visit visit,
               Margin margin) {
  return PairWalk<Visit, Margin>(a, b, a_from_b, visit, margin).walk(0, 0);
}

/// Calls test(triangle of mesh, triangle of other mesh in the first's frame) until one is true.
template <class Test>
bool anyTriangles(const Mesh& a, const Mesh& b, const Isometry3d& a_from_b, const Mesh::Node& p,
                  const Mesh::Node& q, Test test) {
  for (int k = q.first; k < q.first + q.count; ++k) {
    const Triangle other = moved(a_from_b, b.triangles()[k]);
    for (int i = p.first; i < p.first + p.count; ++i)
      if (test(a.triangles()[i], other)) return true;
  }
  return false;
}

bool surfaceMeets(const Mesh& mesh, const Piece& a, const Piece& solid,
                  const Isometry3d& solid_from_a) {
  auto leaf = [&](const Mesh::Node* p, const Mesh::Node*) {
    for (int i = p->first; i < p->first + p->count; ++i)
      if (overlap(solid.primitive, moved(solid_from_a, mesh.triangles()[i]))) return true;
    return false;
  };
  return forLeaves(a, solid, solid_from_a.inverse(), leaf, [] { return 0.0; });
}

bool surfacesMeet(const Piece& a, const Piece& b, const Isometry3d& a_from_b) {
  auto leaf = [&](const Mesh::Node* p, const Mesh::Node* q) {
    return anyTriangles(*a.mesh, *b.mesh, a_from_b, *p, *q,
                        [](const Triangle& s, const Triangle& t) { return overlap(s, t); });
  };
  return forLeaves(a, b, a_from_b, leaf, [] { return 0.0; });
}

bool holdsPartOf(const Mesh& a, const Mesh& b, const Isometry3d& a_from_b) {
  return a.closedParts() > 0 &&
         std::any_of(b.representatives().begin(), b.representatives().end(),
                     [&](const Vector3d& p) { return a.encloses(a_from_b * p); });
}

/// m, by how much both pieces may be off.
double rounding(const Piece& a, const Piece& b) {
  return (a.mesh ? a.mesh->rounding() : 0.0) + (b.mesh ? b.mesh->rounding() : 0.0);
}

struct Least {
  Gap gap;
  void add(const Gap& other) {
    gap.lower = std::min(gap.lower, other.lower);
    gap.upper = std::min(gap.upper, other.upper);
  }
};

}  // namespace

Piece::Piece(const Primitive& solid)
    : primitive(solid),
      boxCenter(Vector3d::Zero()),
      boxHalf(bounds(solid)),
      radius(boxHalf.norm()) {}

Piece::Piece(std::shared_ptr<const Mesh> triangles)
    : mesh(std::move(triangles)),
      boxCenter(mesh->nodes().front().center),
      boxHalf(mesh->nodes().front().half),
      radius(0.0) {
  for (const Triangle& t : mesh->triangles())
    for (const Vector3d& p : t) radius = std::max(radius, (p - boxCenter).norm());
}

bool overlap(const Piece& a, const Piece& b, const Isometry3d& a_from_b) {
  if (!a.mesh && !b.mesh)
    return BoxFilter(a_from_b).near(a.boxCenter, a.boxHalf, b.boxCenter, b.boxHalf, 0.0) &&
           overlap(a.primitive, b.primitive, a_from_b);
  if (!a.mesh) return overlap(b, a, a_from_b.inverse());
  if (!BoxFilter(a_from_b).near(a.boxCenter, a.boxHalf, b.boxCenter, b.boxHalf, 0.0)) return false;
  if (!b.mesh)
    return surfaceMeets(*a.mesh, a, b, a_from_b.inverse()) ||
           a.mesh->encloses(a_from_b.translation());
  return surfacesMeet(a, b, a_from_b) || holdsPartOf(*a.mesh, *b.mesh, a_from_b) ||
         holdsPartOf(*b.mesh, *a.mesh, a_from_b.inverse());
}

/// Displacements that keep two convex solids overlapping are a convex set. It has the ball of
/// radius `off` if it has this octahedron's corners. Solids that are not convex are nearly so, as
/// that ball is tiny.
bool surelyOverlap(const Piece& a, const Piece& b, const Isometry3d& a_from_b) {
  if (!overlap(a, b, a_from_b)) return false;
  const double off = rounding(a, b);
  if (off == 0.0) return true;
  const double corner = std::sqrt(3.0) * off;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-corner, corner})
      if (!overlap(a, b, Eigen::Translation3d(side * Vector3d::Unit(axis)) * a_from_b))
        return false;
  return true;
}

Gap gap(const Piece& a, const Piece& b, const Isometry3d& a_from_b, double enough) {
  if (!a.mesh && b.mesh) return gap(b, a, a_from_b.inverse(), enough);
  if (!BoxFilter(a_from_b).near(a.boxCenter, a.boxHalf, b.boxCenter, b.boxHalf, enough))
    return {enough, enough};
  const double off = rounding(a, b);
  if (overlap(a, b, a_from_b)) return {0.0, off};
  if (!a.mesh) return gap(a.primitive, b.primitive, a_from_b);
  Least least{{enough, enough}};
  const Isometry3d b_from_a = a_from_b.inverse();
  auto leaf = [&](const Mesh::Node* p, const Mesh::Node* q) {
    if (q)
      return anyTriangles(*a.mesh, *b.mesh, a_from_b, *p, *q,
                          [&](const Triangle& s, const Triangle& t) {
                            least.add(gap(s, t, least.gap.upper));
                            return false;
                          });
    for (int i = p->first; i < p->first + p->count; ++i)
      least.add(gap(b.primitive, moved(b_from_a, a.mesh->triangles()[i]), least.gap.upper));
    return false;
  };
  forLeaves(a, b, a_from_b, leaf, [&] { return least.gap.upper; });
  return {std::max(0.0, least.gap.lower - off), least.gap.upper + off};
}

double distanceTo(const Piece& piece, const Vector3d& p) {
  return piece.mesh ? piece.mesh->distanceTo(p) : distanceTo(piece.primitive, p);
}

}  // namespace oracle
