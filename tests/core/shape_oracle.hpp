// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "reference_distance.hpp"
#include "swept/core/shapes.hpp"

/// Support points and membership of every shape, straight from its definition: what refutes a wrong
/// certificate without asking the library.
namespace oracle {

using Eigen::Isometry3d;
using Eigen::Vector3d;

template <typename Points>
Vector3d farthest(const Points& points, const Vector3d& n) {
  return *std::max_element(points.begin(), points.end(), [&](const Vector3d& a, const Vector3d& b) {
    return a.dot(n) < b.dot(n);
  });
}

/// The point farthest along the unit vector n. Of planes and half-spaces, which have one only along
/// their normal: the point nearest to the origin.
struct SupportPoint {
  Vector3d n;

  Vector3d operator()(const swept::Sphere& s) const { return s.radius * n; }
  Vector3d operator()(const swept::Box& s) const {
    return s.halfExtents.cwiseProduct(n.unaryExpr([](double x) { return x < 0.0 ? -1.0 : 1.0; }));
  }
  Vector3d operator()(const swept::Cylinder& s) const { return rim(s.radius) + end(s.halfLength); }
  Vector3d operator()(const swept::Capsule& s) const { return s.radius * n + end(s.halfLength); }
  Vector3d operator()(const swept::Cone& s) const {
    const Vector3d apex(0.0, 0.0, s.halfLength);
    const Vector3d base = rim(s.radius) - apex;
    return n.dot(apex) > n.dot(base) ? apex : base;
  }
  Vector3d operator()(const swept::Ellipsoid& s) const {
    const Vector3d stretched = s.semiAxes.cwiseProduct(n);
    const double length = stretched.norm();
    if (!(length > 0.0)) return Vector3d::Zero();
    return s.semiAxes.cwiseProduct(stretched / length);
  }
  Vector3d operator()(const swept::ConvexHull& s) const { return farthest(s.vertices(), n); }
  Vector3d operator()(const swept::Triangle& s) const { return farthest(s.corners, n); }
  Vector3d operator()(const swept::Plane& s) const { return s.offset * s.normal; }
  Vector3d operator()(const swept::HalfSpace& s) const { return s.offset * s.normal; }
  Vector3d operator()(const swept::TriangleMesh& s) const { return farthest(s.vertices(), n); }
  Vector3d operator()(const swept::PointCloud& s) const {
    std::vector<Vector3d> tips = s.points();
    for (std::size_t i = 0; i < tips.size(); ++i) tips[i] += s.radius(i) * n;
    return farthest(tips, n);
  }

 private:
  Vector3d rim(double radius) const {
    const double across = std::hypot(n.x(), n.y());
    if (!(across > 0.0)) return {radius, 0.0, 0.0};
    return {radius * (n.x() / across), radius * (n.y() / across), 0.0};
  }
  Vector3d end(double half) const { return {0.0, 0.0, n.z() < 0.0 ? -half : half}; }
};

inline Vector3d support(const swept::Shape& shape, const Vector3d& n) {
  return std::visit(SupportPoint{n}, shape);
}

/// m. At least zero; not more than a few times the distance of a point from the shape, and zero
/// only inside.
struct Outside {
  Vector3d p;

  double operator()(const swept::Sphere& s) const { return std::max(0.0, p.norm() - s.radius); }
  double operator()(const swept::Box& s) const { return reference::pointBox(p, s.halfExtents); }
  double operator()(const swept::Cylinder& s) const {
    return reference::pointCylinder(p, s.radius, s.halfLength);
  }
  double operator()(const swept::Capsule& s) const {
    const Vector3d tip(0.0, 0.0, s.halfLength);
    return std::max(0.0, reference::pointSegment(p, -tip, tip) - s.radius);
  }
  double operator()(const swept::Cone& s) const {
    const double slant = std::hypot(s.radius, 2.0 * s.halfLength);
    const double rho = std::hypot(p.x(), p.y());
    const double beyond = std::abs(p.z()) - s.halfLength;
    if (!(slant > 0.0)) return p.norm();
    const double side =
        ((rho - s.radius) * 2.0 * s.halfLength + (p.z() + s.halfLength) * s.radius) / slant;
    return std::max({0.0, side, beyond, rho - s.radius});
  }
  /// To first order, and never more than the distance, since the level is a convex function.
  double operator()(const swept::Ellipsoid& s) const {
    double level = 0.0;
    double flat = 0.0;
    Vector3d gradient = Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      if (s.semiAxes[i] > 0.0) {
        const double share = p[i] / s.semiAxes[i];
        level += share * share;
        gradient[i] = 2.0 * share / s.semiAxes[i];
      } else {
        flat = std::max(flat, std::abs(p[i]));
      }
    }
    return std::max(flat, level > 1.0 ? (level - 1.0) / gradient.norm() : 0.0);
  }
  double operator()(const swept::ConvexHull& s) const {
    if (s.faces().empty()) return fromFlat(s.vertices());
    double most = 0.0;
    for (const Eigen::Vector3i& f : s.faces()) {
      const auto& v = s.vertices();
      const Vector3d n = (v[f[1]] - v[f[0]]).cross(v[f[2]] - v[f[0]]).normalized();
      most = std::max(most, n.dot(p - v[f[0]]));
    }
    return most;
  }
  double operator()(const swept::Triangle& s) const {
    return reference::pointTriangle(p, s.corners);
  }
  double operator()(const swept::Plane& s) const { return std::abs(s.normal.dot(p) - s.offset); }
  double operator()(const swept::HalfSpace& s) const {
    return std::max(0.0, s.normal.dot(p) - s.offset);
  }
  double operator()(const swept::TriangleMesh& s) const {
    const auto triangles = reference::trianglesOf(s.vertices(), s.triangles());
    if (s.interior() == swept::MeshInterior::Solid && isClosed(s.triangles()) &&
        std::abs(reference::windingNumber(triangles, p)) > 0.5) {
      return 0.0;
    }
    double least = std::numeric_limits<double>::infinity();
    for (const auto& t : triangles) least = std::min(least, reference::pointTriangle(p, t));
    return least;
  }
  double operator()(const swept::PointCloud& s) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < s.points().size(); ++i)
      least = std::min(least, (p - s.points()[i]).norm() - s.radius(i));
    return std::max(0.0, least);
  }

 private:
  /// From the hull of points in one plane, on a line or in one place: the triangles of the first
  /// with any two cover it.
  double fromFlat(const std::vector<Vector3d>& points) const {
    constexpr std::size_t kMost = 64;  // pairs of them are looked at
    if (points.size() > kMost) throw std::length_error("oracle: a flat hull of too many points");
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t k = i; k < points.size(); ++k)
        least = std::min(least, reference::pointTriangle(p, {points[0], points[i], points[k]}));
    }
    return least;
  }
  /// Each edge is passed through as often one way as the other.
  static bool isClosed(const std::vector<Eigen::Vector3i>& triangles) {
    std::map<std::pair<int, int>, int> ways;
    for (const Eigen::Vector3i& t : triangles) {
      for (int i = 0; i < 3; ++i) {
        const int from = t[i], to = t[(i + 1) % 3];
        ways[std::minmax(from, to)] += from < to ? 1 : -1;
      }
    }
    return std::all_of(ways.begin(), ways.end(), [](const auto& way) { return way.second == 0; });
  }
};

inline double outside(const swept::Shape& shape, const Vector3d& p) {
  return std::visit(Outside{p}, shape);
}

inline const Vector3d* flatNormal(const swept::Shape& shape) {
  if (const auto* plane = std::get_if<swept::Plane>(&shape)) return &plane->normal;
  if (const auto* space = std::get_if<swept::HalfSpace>(&shape)) return &space->normal;
  return nullptr;
}

/// m, of the coordinates that meet in a query: what rounding is relative to.
inline double magnitude(const swept::Shape& a, const swept::Shape& b, const Isometry3d& a_from_b) {
  const auto reach = [](const swept::Shape& shape) {
    if (const auto* plane = std::get_if<swept::Plane>(&shape)) return std::abs(plane->offset);
    if (const auto* space = std::get_if<swept::HalfSpace>(&shape)) return std::abs(space->offset);
    const swept::BoundingSphere ball = swept::boundingSphere(shape);
    return ball.center.norm() + ball.radius;
  };
  return reach(a) + reach(b) + a_from_b.translation().norm();
}

/// m. How far apart the slab with unit normal n keeps a (behind) from b (ahead); negative where
/// they overlap along n. -infinity across a plane or half-space that n is not normal to.
inline double slab(const swept::Shape& a, const swept::Shape& b, const Isometry3d& a_from_b,
                   const Vector3d& n) {
  constexpr double kAcross = 4e-15;
  const Vector3d inB = a_from_b.linear().transpose() * n;
  const auto ends = [](const swept::Shape& shape, const Vector3d& out) {
    const Vector3d* normal = flatNormal(shape);
    if (normal == nullptr) return true;
    const bool along = (*normal - out).norm() < kAcross;
    const bool against = (*normal + out).norm() < kAcross;
    return along || (against && std::holds_alternative<swept::Plane>(shape));
  };
  if (!ends(a, n) || !ends(b, -inB)) return -std::numeric_limits<double>::infinity();
  return n.dot(a_from_b * support(b, -inB) - support(a, n));
}

}  // namespace oracle
