// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/epa.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

constexpr int kMaxVertices = 256;
constexpr int kMaxFaces = 2 * kMaxVertices;
constexpr double kLeastSine =
    1e-9;  ///< of the angle between a face's edges: thinner ones have no normal

struct Face {
  std::array<int, 3> vertex;  ///< counter-clockwise seen from outside
  Vector3d normal;            ///< unit, outward
  double distance;            ///< m, of its plane from the origin
};

class Polytope {
 public:
  Polytope(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b)
      : a_(a), b_(b), rotation_(a_from_b.linear()), offset_(a_from_b.translation()) {
    magnitude_ = a.extent + b.extent + offset_.norm();
  }

  double rounding() const { return tolerance::kSupportRounding * magnitude_ + a_.error + b_.error; }
  int evaluations() const { return evaluations_; }
  const Face& face(int i) const { return faces_[i]; }
  int faceCount() const { return faceCount_; }
  const Simplex::Vertex& vertex(int i) const { return vertices_[i]; }

  /// Point of B - A farthest along n.
  Simplex::Vertex support(const Vector3d& n) {
    ++evaluations_;
    const Vector3d onA = a_.support(-n);
    const Vector3d onB = rotation_ * b_.support(rotation_.transpose() * n) + offset_;
    return {onB - onA, onA, onB, 0.0};
  }

  /// A tetrahedron with the simplex among its faces, edges or corners. On failure `flat` is a
  /// direction along which B - A has no extent.
  bool start(const Simplex& simplex, Vector3d& flat) {
    for (int i = 0; i < simplex.size; ++i) vertices_[vertexCount_++] = simplex.vertices[i];
    const double least = 4.0 * rounding();
    if (vertexCount_ == 4 && volume() <= least * least * least) vertexCount_ = 3;
    if (vertexCount_ == 3 && area() <= least * least) vertexCount_ = 2;
    if (vertexCount_ == 2 && (difference(1) - difference(0)).norm() <= least) vertexCount_ = 1;
    while (vertexCount_ < 4) {
      if (!widen(least, flat)) return false;
    }
    center_ = 0.25 * (difference(0) + difference(1) + difference(2) + difference(3));
    return add(0, 1, 2) && add(0, 3, 1) && add(0, 2, 3) && add(1, 3, 2);
  }

  int nearestFace() const {
    int best = 0;
    for (int i = 1; i < faceCount_; ++i) {
      if (faces_[i].distance < faces_[best].distance) best = i;
    }
    return best;
  }

  /// Replaces the faces that see the new vertex by a fan from their border. False when the polytope
  /// would no longer be one; then it is left as it was.
  bool expand(const Simplex::Vertex& added) {
    // A vertex in the plane of a face beside the hole may lie on the line of their common edge, and
    // the fan would get a face without area. Faces in whose plane it lies are better replaced too.
    return expand(added, 0.0) || expand(added, -4.0 * rounding());
  }

 private:
  bool expand(const Simplex::Vertex& added, double above) {
    if (vertexCount_ == kMaxVertices) return false;
    borderCount_ = 0;
    std::array<bool, kMaxFaces> visible;
    int visibleCount = 0;
    for (int i = 0; i < faceCount_; ++i) {
      const Face& face = faces_[i];
      visible[i] = face.normal.dot(added.difference) > face.distance + above;
      if (!visible[i]) continue;
      ++visibleCount;
      for (int k = 0; k < 3; ++k) toggle(face.vertex[k], face.vertex[(k + 1) % 3]);
    }
    if (visibleCount == 0 || visibleCount == faceCount_ || !borderIsOneLoop()) return false;
    if (faceCount_ - visibleCount + borderCount_ > kMaxFaces) return false;
    const int apex = vertexCount_;
    vertices_[apex] = added;
    std::array<Face, kMaxFaces> fresh;
    for (int i = 0; i < borderCount_; ++i) {
      if (!makeFace({border_[i][0], border_[i][1], apex}, fresh[i])) return false;
    }
    ++vertexCount_;
    int kept = 0;
    for (int i = 0; i < faceCount_; ++i) {
      if (!visible[i]) faces_[kept++] = faces_[i];
    }
    std::copy_n(fresh.begin(), borderCount_, faces_.begin() + kept);
    faceCount_ = kept + borderCount_;
    return true;
  }

  const Vector3d& difference(int i) const { return vertices_[i].difference; }
  Vector3d edge(int i) const { return difference(i) - difference(0); }
  double area() const { return edge(1).cross(edge(2)).norm(); }
  double volume() const { return std::abs(edge(1).cross(edge(2)).dot(edge(3))); }

  /// Adds a support point off the affine hull of the vertices so far.
  bool widen(double least, Vector3d& flat) {
    std::array<Vector3d, 3> directions{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
    int count = 3;
    if (vertexCount_ == 2) {
      const Vector3d along = edge(1).normalized();
      directions[0] = along.unitOrthogonal();
      directions[1] = along.cross(directions[0]);
      count = 2;
    } else if (vertexCount_ == 3) {
      directions[0] = edge(1).cross(edge(2)).normalized();
      count = 1;
    }
    for (int i = 0; i < count; ++i) {
      for (const double sign : {1.0, -1.0}) {
        const Vector3d n = sign * directions[i];
        const Simplex::Vertex found = support(n);
        if (!(n.dot(found.difference - difference(0)) > least)) continue;
        vertices_[vertexCount_++] = found;
        return true;
      }
      flat = directions[i];
    }
    return false;
  }

  bool makeFace(std::array<int, 3> corners, Face& face) const {
    const Vector3d& p = difference(corners[0]);
    const Vector3d e = difference(corners[1]) - p;
    const Vector3d f = difference(corners[2]) - p;
    Vector3d normal = e.cross(f);
    const double norm = normal.norm();
    if (!(norm > kLeastSine * e.norm() * f.norm())) return false;
    normal /= norm;
    if (normal.dot(p - center_) < 0.0) {
      normal = -normal;
      std::swap(corners[1], corners[2]);
    }
    face = {corners, normal, normal.dot(p)};
    return true;
  }

  bool add(int i, int j, int k) { return makeFace({i, j, k}, faces_[faceCount_++]); }

  /// An edge shared by two visible faces is inside the hole; one seen once is its border.
  void toggle(int from, int to) {
    for (int i = 0; i < borderCount_; ++i) {
      if (border_[i][0] == to && border_[i][1] == from) {
        border_[i] = border_[--borderCount_];
        return;
      }
    }
    if (borderCount_ < kMaxFaces) border_[borderCount_++] = {from, to};
  }

  bool borderIsOneLoop() const {
    if (borderCount_ < 3 || borderCount_ >= kMaxFaces) return false;
    int at = border_[0][1];
    for (int steps = 1; steps < borderCount_; ++steps) {
      int next = -1;
      for (int i = 0; i < borderCount_; ++i) {
        if (border_[i][0] == at) next = border_[i][1];
      }
      if (next < 0 || at == border_[0][0]) return false;
      at = next;
    }
    return at == border_[0][0];
  }

  const Convex& a_;
  const Convex& b_;
  Eigen::Matrix3d rotation_;
  Vector3d offset_;
  Vector3d center_ = Vector3d::Zero();
  double magnitude_ = 0.0;
  std::array<Simplex::Vertex, kMaxVertices> vertices_;
  std::array<Face, kMaxFaces> faces_;
  std::array<std::array<int, 2>, kMaxFaces> border_;
  int vertexCount_ = 0;
  int faceCount_ = 0;
  int borderCount_ = 0;
  int evaluations_ = 0;
};

/// Deepest points: the boundary's point nearest to the origin, carried over to the two bodies. Of
/// several faces in the nearest plane, one holds it.
void witness(const Polytope& polytope, double rounding, EpaResult& result) {
  const double nearest = polytope.face(polytope.nearestFace()).distance;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < polytope.faceCount(); ++i) {
    if (polytope.face(i).distance > nearest + rounding) continue;
    Simplex simplex;
    for (const int k : polytope.face(i).vertex) {
      simplex.vertices[simplex.size++] = polytope.vertex(k);
    }
    const double distance = simplex.reduceToNearest().norm();
    if (!(distance < least)) continue;
    least = distance;
    result.pointA = simplex.pointA();
    result.pointB = simplex.pointB();
  }
}

}  // namespace

EpaResult epa(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b,
              const Simplex& start, double tolerance) {
  Polytope polytope(a, b, a_from_b);
  const double rounding = polytope.rounding();
  EpaResult result;
  result.pointA = start.pointA();
  result.pointB = start.pointB();
  Vector3d flat = Vector3d::UnitX();
  if (!polytope.start(start, flat)) {
    // No extent along `flat`: the least translation along it ends the contact.
    const double ahead = flat.dot(polytope.support(flat).difference);
    const double behind = -flat.dot(polytope.support(-flat).difference);
    result.normal = ahead <= behind ? Vector3d(-flat) : flat;
    result.upper = std::max(0.0, std::min(ahead, behind)) + rounding;
    result.iterations = polytope.evaluations();
    return result;
  }
  // Lemma: the depth is the least support value of B - A over all directions, hence at most the one
  // along any normal tried, and at least the distance of the nearest face of a polytope inside.
  result.upper = std::numeric_limits<double>::infinity();
  while (true) {
    const Face nearest = polytope.face(polytope.nearestFace());
    result.lower = std::max(result.lower, nearest.distance - rounding);
    const Simplex::Vertex found = polytope.support(nearest.normal);
    const double height = nearest.normal.dot(found.difference);
    if (height + rounding < result.upper) {
      result.upper = height + rounding;
      result.normal = -nearest.normal;
    }
    if (height - nearest.distance <= tolerance || !polytope.expand(found)) break;
  }
  witness(polytope, rounding + tolerance, result);
  result.upper = std::max(result.upper, 0.0);
  result.lower = std::clamp(result.lower, 0.0, result.upper);
  result.iterations = polytope.evaluations();
  return result;
}

}  // namespace swept::detail
