// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "error_table_descent.hpp"
#include "error_table_placement.hpp"

namespace error_table {

/// The depth as the least overlap over all directions: of cores that overlap, radii added.
///
/// At a least overlap the support planes touch the difference of the bodies at a point where it has
/// a face, is ruled, or is smooth. Those directions are: normals of faces and cross products of
/// edges; circles (across an edge or an axis, and of a cone's side); and, where two curved surfaces
/// meet or one is an ellipsoid, any. The first are exact, the others refined from many starts until
/// the overlap no longer falls. Directions are those from a to b, in a's frame.
class DeepestOverlap {
 public:
  DeepestOverlap(const Body& a, const Body& b, const Isometry3d& a_from_b)
      : a_(a),
        b_(b),
        a_from_b_(a_from_b),
        turn_(a_from_b.linear()),
        scale_(a.extent + b.extent + a_from_b.translation().norm()) {
    if (b.core == Body::Core::Points) {
      for (const Vector3d& p : b.points) moved_.push_back(a_from_b * p);
    }
  }

  /// `hint`: a direction to start from too.
  Truth run(const Vector3d& hint) {
    if (a_.isFlat() || b_.isFlat()) return ofFlat();
    corners();
    if (a_.isCurved() || b_.isCurved()) {
      circles(a_, Matrix3d::Identity());
      circles(b_, a_from_b_.linear());
      if (isSmooth()) anywhere(hint);
    }
    return exactly();
  }

 private:
  /// Of an edge or face of each, or of one alone (-1: none).
  struct Corner {
    int a, b;
    double sign;
    double overlap;
  };

  bool isSmooth() const {
    return (a_.isCurved() && b_.isCurved()) || a_.core == Body::Core::Ellipsoid ||
           b_.core == Body::Core::Ellipsoid;
  }

  double overlap(const Vector3d& n) const {
    if (moved_.empty()) {
      return a_.reach(n) + b_.reach(-(a_from_b_.linear().transpose() * n)) -
             n.dot(a_from_b_.translation());
    }
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3d& p : moved_) least = std::min(least, n.dot(p));
    return a_.reach(n) - least;
  }

  void tryNormal(const Vector3d& n) {
    const double found = overlap(n);
    if (found < best_) {
      best_ = found;
      bestNormal_ = n;
    }
  }

  void tryCorner(const Vector3d& n, int i, int j) {
    for (const double sign : {1.0, -1.0}) {
      corners_.push_back({i, j, sign, overlap(sign * n)});
    }
  }

  void corners() {
    for (int i = 0; i < static_cast<int>(a_.faces.size()); ++i) {
      tryCorner(approximate(a_, i), i, -1);
    }
    for (int j = 0; j < static_cast<int>(b_.faces.size()); ++j) {
      tryCorner(a_from_b_.linear() * approximate(b_, j), -1, j);
    }
    for (int i = 0; i < static_cast<int>(a_.edges.size()); ++i) {
      const Vector3d u = rounded(a_.edgeVector(i)).normalized();
      for (int j = 0; j < static_cast<int>(b_.edges.size()); ++j) {
        const Vector3d n = u.cross(a_from_b_.linear() * rounded(b_.edgeVector(j)).normalized());
        if (n.norm() > 1e-6) tryCorner(n.normalized(), i, j);
      }
    }
  }

  static Vector3d approximate(const Body& body, int face) {
    const Eigen::Vector3i& f = body.faces[face];
    const Vector3d p = body.points[f[0]];
    return (body.points[f[1]] - p).cross(body.points[f[2]] - p).normalized();
  }

  Point exactCorner(const Corner& c) const {
    const Real sign = c.sign;
    if (c.b < 0) return a_.faceNormal(c.a) * sign;
    if (c.a < 0) return unit(turn_.normal(b_.faceNormal(c.b))) * sign;
    return unit(a_.edgeVector(c.a).cross(turn_ * b_.edgeVector(c.b))) * sign;
  }

  void circles(const Body& body, const Matrix3d& turn) {
    const auto circle = [&](const Vector3d& axis, double height) {
      const Vector3d center = turn * (height * axis);
      const Vector3d u = turn * (std::sqrt(1.0 - height * height) * axis.unitOrthogonal());
      leastOnCircle(
          center, u, (turn * axis).cross(u), scale_, best_,
          [&](const Vector3d& n) { return overlap(n); }, [&](const Vector3d& n) { tryNormal(n); });
    };
    for (std::size_t i = 0; i < body.edges.size(); ++i) {
      circle(rounded(body.edgeVector(static_cast<int>(i))).normalized(), 0.0);
    }
    const Vector3d z = Vector3d::UnitZ();
    if (body.core == Body::Core::Cylinder) circle(z, 0.0);
    if (body.core == Body::Core::Cone) {
      const double height = body.size.x() / std::hypot(body.size.x(), 2.0 * body.size.z());
      circle(z, height);
      circle(z, -height);
    }
    if (body.core == Body::Core::Cylinder || body.core == Body::Core::Cone) {
      tryNormal(turn * z);
      tryNormal(-(turn * z));
    }
  }

  void anywhere(const Vector3d& hint) {
    const auto f = [&](const Vector3d& n) { return overlap(n); };
    for (const Vector3d& n : promising(8, f)) tryNormal(descend(n, f));
    if (hint.squaredNorm() > 0.5) tryNormal(descend(hint.normalized(), f));
  }

  Real exactOverlap(const Point& n) const {
    Random random(1);
    const Point m = unit(turn_.transposed(n) * Real(-1));
    const Point b = turn_ * supportOfCore(b_, m, 0.0, random).point;
    const Point t = real(Vector3d(a_from_b_.translation()));
    return n.dot(supportOfCore(a_, n, 0.0, random).point - b - t);
  }

  /// The only ways out of a plane and of a half-space.
  Truth ofFlat() const {
    const bool ofA = a_.isFlat() && !(b_.isFlat() && b_.halfSpace);
    const Point n = ofA ? unit(real(a_.size)) : unit(turn_.normal(real(b_.size))) * Real(-1);
    Real depth = exactOverlap(n);
    if (!(a_.halfSpace || b_.halfSpace)) depth = std::min(depth, exactOverlap(n * Real(-1)));
    const Real grown = depth + a_.radius + b_.radius;
    return {-grown, -grown};
  }

  Truth exactly() {
    double least = best_;
    for (const Corner& c : corners_) least = std::min(least, c.overlap);
    Real depth = std::numeric_limits<double>::infinity();
    for (const Corner& c : corners_) {
      if (c.overlap < least + 1e-10 * scale_) {
        depth = std::min(depth, exactOverlap(exactCorner(c)));
      }
    }
    Real slack = 0;
    if (best_ < least + 1e-10 * scale_) {
      const Real found = exactOverlap(unit(real(bestNormal_)));
      if (found < depth) slack = 1e-15 * scale_;
      depth = std::min(depth, found);
    }
    const Real grown = depth + a_.radius + b_.radius;
    return {-grown, -(grown - slack)};
  }

  const Body& a_;
  const Body& b_;
  const Isometry3d& a_from_b_;
  const ExactTurn turn_;
  const double scale_;
  std::vector<Vector3d> moved_;  ///< b's points
  std::vector<Corner> corners_;
  double best_ = std::numeric_limits<double>::infinity();
  Vector3d bestNormal_ = Vector3d::Zero();
};

}  // namespace error_table
