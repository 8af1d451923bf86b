// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

/// Distances by enumeration of features and closed forms, sharing nothing with the library.
namespace reference {

using Eigen::Isometry3d;
using Eigen::Vector3d;

inline double pointSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d d = b - a;
  const double length = d.squaredNorm();
  const double t = length > 0.0 ? std::clamp((p - a).dot(d) / length, 0.0, 1.0) : 0.0;
  return (a + t * d - p).norm();
}

/// Minimises the quadratic over the square by its interior solution and its four edges.
inline double segmentSegment(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                             const Vector3d& d) {
  double best = std::min(std::min(pointSegment(a, c, d), pointSegment(b, c, d)),
                         std::min(pointSegment(c, a, b), pointSegment(d, a, b)));
  const Vector3d u = b - a;
  const Vector3d v = d - c;
  const double denominator = u.cross(v).squaredNorm();
  if (denominator > 0.0) {
    const Vector3d w = c - a;
    const double s = w.cross(v).dot(u.cross(v)) / denominator;
    const double t = w.cross(u).dot(u.cross(v)) / denominator;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best = std::min(best, (c + t * v - a - s * u).norm());
  }
  return best;
}

inline double pointTriangle(const Vector3d& p, const std::array<Vector3d, 3>& t) {
  double best = std::min(
      {pointSegment(p, t[0], t[1]), pointSegment(p, t[1], t[2]), pointSegment(p, t[2], t[0])});
  const Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]);
  if (n.squaredNorm() > 0.0) {
    const Vector3d foot = p - n * (n.dot(p - t[0]) / n.squaredNorm());
    const bool inside = n.dot((t[1] - t[0]).cross(foot - t[0])) >= 0 &&
                        n.dot((t[2] - t[1]).cross(foot - t[1])) >= 0 &&
                        n.dot((t[0] - t[2]).cross(foot - t[2])) >= 0;
    if (inside) best = std::min(best, (p - foot).norm());
  }
  return best;
}

inline bool segmentCrossesTriangle(const Vector3d& a, const Vector3d& b,
                                   const std::array<Vector3d, 3>& t) {
  const Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double da = n.dot(a - t[0]);
  const double db = n.dot(b - t[0]);
  if ((da > 0 && db > 0) || (da < 0 && db < 0) || da == db) return false;
  const Vector3d p = a + (b - a) * (da / (da - db));
  return n.dot((t[1] - t[0]).cross(p - t[0])) >= 0 && n.dot((t[2] - t[1]).cross(p - t[1])) >= 0 &&
         n.dot((t[0] - t[2]).cross(p - t[2])) >= 0;
}

inline double triangleTriangle(const std::array<Vector3d, 3>& a, const std::array<Vector3d, 3>& b) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (segmentCrossesTriangle(a[i], a[(i + 1) % 3], b)) return 0.0;
    if (segmentCrossesTriangle(b[i], b[(i + 1) % 3], a)) return 0.0;
    best = std::min({best, pointTriangle(a[i], b), pointTriangle(b[i], a)});
    for (int j = 0; j < 3; ++j) {
      best = std::min(best, segmentSegment(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
    }
  }
  return best;
}

using Triangles = std::vector<std::array<Vector3d, 3>>;

inline double surfaces(const Triangles& a, const Triangles& b) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& s : a)
    for (const auto& t : b) best = std::min(best, triangleTriangle(s, t));
  return best;
}

/// Of a triangle as seen from p (Van Oosterom, Strackee 1983); of a closed surface, 4 pi in all for
/// each time that it winds around p.
inline double solidAngle(const Vector3d& p, const std::array<Vector3d, 3>& t) {
  const Vector3d a = t[0] - p;
  const Vector3d b = t[1] - p;
  const Vector3d c = t[2] - p;
  const double across = a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() + b.dot(c) * a.norm() +
                        c.dot(a) * b.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), across);
}

inline double windingNumber(const Triangles& triangles, const Vector3d& p) {
  double angle = 0.0;
  for (const auto& t : triangles) angle += solidAngle(p, t);
  return angle / (4.0 * std::numbers::pi);
}

/// Corners of the triangles of anything indexed.
template <typename Indices>
Triangles trianglesOf(const std::vector<Vector3d>& vertices, const Indices& indices) {
  Triangles triangles;
  for (const auto& t : indices)
    triangles.push_back({vertices[t[0]], vertices[t[1]], vertices[t[2]]});
  return triangles;
}

inline Triangles boxTriangles(const Vector3d& half, const Isometry3d& pose) {
  Triangles triangles;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      std::array<Vector3d, 4> corner;
      for (int k = 0; k < 4; ++k) {
        Vector3d p;
        p[axis] = side * half[axis];
        p[(axis + 1) % 3] = (k == 1 || k == 2 ? 1 : -1) * half[(axis + 1) % 3];
        p[(axis + 2) % 3] = (k >= 2 ? 1 : -1) * half[(axis + 2) % 3];
        corner[k] = pose * p;
      }
      triangles.push_back({corner[0], corner[1], corner[2]});
      triangles.push_back({corner[0], corner[2], corner[3]});
    }
  }
  return triangles;
}

inline double pointBox(const Vector3d& p, const Vector3d& half) {
  return (p.cwiseAbs() - half).cwiseMax(Vector3d::Zero()).norm();
}

inline double pointCylinder(const Vector3d& p, double radius, double halfLength) {
  return std::hypot(std::max(0.0, std::hypot(p.x(), p.y()) - radius),
                    std::max(0.0, std::abs(p.z()) - halfLength));
}

/// Draws within braces, which have an order: arguments of a call have none, and each compiler would
/// test other samples.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vector3d vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  Vector3d direction() {
    std::normal_distribution<double> normal;
    return Vector3d{normal(engine_), normal(engine_), normal(engine_)}.normalized();
  }
  Isometry3d pose(double size) {
    Isometry3d result = Isometry3d::Identity();
    std::normal_distribution<double> normal;
    result.linear() =
        Eigen::Quaterniond{normal(engine_), normal(engine_), normal(engine_), normal(engine_)}
            .normalized()
            .toRotationMatrix();
    result.translation() = vector(size);
    return result;
  }

 private:
  std::mt19937 engine_;
};

}  // namespace reference
