// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <variant>
#include <vector>

#include "mesh_samples.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/sphere_cover.hpp"

/// Points of shapes and distances from them, in closed form or by trying every triangle, for
/// judging covers.
namespace swept::test {

inline double distanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                const Eigen::Vector3d& b) {
  const Eigen::Vector3d ab = b - a;
  const double length = ab.squaredNorm();
  const double t = length > 0.0 ? std::clamp((p - a).dot(ab) / length, 0.0, 1.0) : 0.0;
  return (p - a - t * ab).norm();
}

inline double distanceToTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                 const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  double nearest = std::min(
      {distanceToSegment(p, a, b), distanceToSegment(p, b, c), distanceToSegment(p, c, a)});
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double length = normal.norm();
  if (length == 0.0) return nearest;
  const bool isOver = normal.dot((b - a).cross(p - a)) >= 0.0 &&
                      normal.dot((c - b).cross(p - b)) >= 0.0 &&
                      normal.dot((a - c).cross(p - c)) >= 0.0;
  return isOver ? std::min(nearest, std::abs(normal.dot(p - a)) / length) : nearest;
}

/// Winding number (Van Oosterom and Strackee 1983) of all triangles together.
inline double windingNumber(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  double sum = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles()) {
    const Eigen::Vector3d a = mesh.vertices()[t[0]] - point;
    const Eigen::Vector3d b = mesh.vertices()[t[1]] - point;
    const Eigen::Vector3d c = mesh.vertices()[t[2]] - point;
    const double across = a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                          b.dot(c) * a.norm() + c.dot(a) * b.norm();
    sum += 2.0 * std::atan2(a.dot(b.cross(c)), across);
  }
  return sum / (4.0 * std::numbers::pi);
}

/// Whether a mesh whose components are all oriented the same way contains a point.
inline bool isInside(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  return mesh.isClosed() && mesh.interior() == MeshInterior::Solid &&
         std::abs(windingNumber(mesh, point)) > 0.5;
}

/// Distance of a point from a flat region, by its profile: (radial, axial) >= 0 from the corner.
inline double outside(double x, double y) {
  return std::hypot(std::max(x, 0.0), std::max(y, 0.0));
}

/// Distance of a point from a shape, 0 inside.
struct DistanceOf {
  Eigen::Vector3d p;

  double operator()(const Sphere& s) const { return std::max(0.0, p.norm() - s.radius); }
  double operator()(const Box& s) const {
    return (p.cwiseAbs() - s.halfExtents).cwiseMax(0.0).norm();
  }
  double operator()(const Cylinder& s) const {
    return outside(p.head<2>().norm() - s.radius, std::abs(p.z()) - s.halfLength);
  }
  double operator()(const Capsule& s) const {
    const Eigen::Vector3d end(0.0, 0.0, s.halfLength);
    return std::max(0.0, distanceToSegment(p, -end, end) - s.radius);
  }
  double operator()(const Cone& s) const {
    const double radial = p.head<2>().norm();
    const double height = 2.0 * s.halfLength;
    const double above = p.z() + s.halfLength;
    if (above >= 0.0 && radial * height <= s.radius * (height - above)) return 0.0;
    return distanceToTriangle({radial, 0.0, p.z()}, {0.0, 0.0, -s.halfLength},
                              {s.radius, 0.0, -s.halfLength}, {0.0, 0.0, s.halfLength});
  }
  double operator()(const Triangle& s) const {
    return distanceToTriangle(p, s.corners[0], s.corners[1], s.corners[2]);
  }
  double operator()(const TriangleMesh& s) const {
    if (isInside(s, p)) return 0.0;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3i& t : s.triangles()) {
      nearest = std::min(nearest, distanceToTriangle(p, s.vertices()[t[0]], s.vertices()[t[1]],
                                                     s.vertices()[t[2]]));
    }
    return nearest;
  }
  double operator()(const PointCloud& s) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < s.points().size(); ++i)
      nearest = std::min(nearest, (p - s.points()[i]).norm() - s.radius(i));
    return std::max(0.0, nearest);
  }
  /// The library's own query, which shares nothing with covers.
  template <typename Other>
  double operator()(const Other& s) const {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = p;
    return distance(s, Sphere{0.0}, pose).lower;
  }
};

/// Points of a shape: inside, on its surface, its vertices and edges.
class SampleOf {
 public:
  SampleOf(std::mt19937& random, int count) : random_(random), count_(count) {}

  using Points = std::vector<Eigen::Vector3d>;
  Points operator()(const Sphere& s) const {
    return repeat([&] { return Eigen::Vector3d(s.radius * inBall()); });
  }
  Points operator()(const Ellipsoid& s) const {
    return repeat([&] { return Eigen::Vector3d(s.semiAxes.cwiseProduct(inBall())); });
  }
  Points operator()(const Box& s) const {
    return repeat([&] {
      return Eigen::Vector3d(
          s.halfExtents.cwiseProduct(Eigen::Vector3d(oftenAtEnd(), oftenAtEnd(), oftenAtEnd())));
    });
  }
  Points operator()(const Cylinder& s) const {
    return repeat([&] {
      const Eigen::Vector2d xy = s.radius * inDisc();
      return Eigen::Vector3d(xy.x(), xy.y(), s.halfLength * oftenAtEnd());
    });
  }
  Points operator()(const Cone& s) const {
    return repeat([&] {
      const double down = 0.5 * (oftenAtEnd() + 1.0);
      const Eigen::Vector2d xy = s.radius * down * inDisc();
      return Eigen::Vector3d(xy.x(), xy.y(), s.halfLength * (1.0 - 2.0 * down));
    });
  }
  Points operator()(const Capsule& s) const {
    return repeat([&] {
      return Eigen::Vector3d(s.radius * inBall() +
                             s.halfLength * oftenAtEnd() * Eigen::Vector3d::UnitZ());
    });
  }
  Points operator()(const Triangle& s) const {
    return repeat([&] { return onTriangle(s.corners[0], s.corners[1], s.corners[2]); });
  }
  Points operator()(const ConvexHull& s) const {
    Points points = s.vertices();
    const auto vertex = [&] {
      return s.vertices()[std::uniform_int_distribution<std::size_t>(
          0, s.vertices().size() - 1)(random_)];
    };
    while (static_cast<int>(points.size()) < count_) {
      const Eigen::Vector3d onFace = onTriangle(vertex(), vertex(), vertex());
      points.push_back(onFace + uniform(random_, 0.0, 1.0) * (vertex() - onFace));
    }
    return points;
  }
  Points operator()(const PointCloud& s) const {
    return repeat([&] {
      const auto index =
          std::uniform_int_distribution<std::size_t>(0, s.points().size() - 1)(random_);
      return Eigen::Vector3d(s.points()[index] + s.radius(index) * inBall());
    });
  }
  Points operator()(const TriangleMesh& s) const {
    Points points = s.vertices();
    const Aabb box = boundingBox(s);
    for (int i = 0; i < count_; ++i) {
      const auto index =
          std::uniform_int_distribution<std::size_t>(0, s.triangles().size() - 1)(random_);
      const Eigen::Vector3i& t = s.triangles()[index];
      points.push_back(onTriangle(s.vertices()[t[0]], s.vertices()[t[1]], s.vertices()[t[2]]));
      const Eigen::Vector3d unit(uniform(random_, 0.0, 1.0), uniform(random_, 0.0, 1.0),
                                 uniform(random_, 0.0, 1.0));
      const Eigen::Vector3d p = box.lower + unit.cwiseProduct(box.upper - box.lower);
      if (i % 4 == 0 && isInside(s, p)) points.push_back(p);
    }
    return points;
  }
  Points operator()(const Plane&) const { return {}; }
  Points operator()(const HalfSpace&) const { return {}; }

 private:
  template <typename Make>
  Points repeat(const Make& make) const {
    Points points;
    for (int i = 0; i < count_; ++i) points.push_back(make());
    return points;
  }
  /// In [-1, 1], every third time one of the ends.
  double oftenAtEnd() const {
    const double value = uniform(random_, -1.5, 1.5);
    return std::clamp(value, -1.0, 1.0);
  }
  Eigen::Vector3d inBall() const {
    return std::min(1.0, uniform(random_, 0.2, 1.6)) * unitVector(random_);
  }
  Eigen::Vector2d inDisc() const {
    const double angle = uniform(random_, 0.0, 2.0 * std::numbers::pi);
    return std::min(1.0, uniform(random_, 0.0, 1.6)) *
           Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  Eigen::Vector3d onTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& c) const {
    const double s = 0.5 * (oftenAtEnd() + 1.0);
    const double t = 0.5 * (oftenAtEnd() + 1.0);
    const Eigen::Vector3d ab = a + s * (b - a);
    return ab + t * (c - ab);
  }

  std::mt19937& random_;
  int count_;
};

/// Whether a path of balls from the root to a leaf contains the point: then every cut of the tree
/// covers it. `slack`: m, what the rounding of the sample may be off by.
inline bool covers(const SphereCover& cover, const Eigen::Vector3d& p, double slack,
                   double shrink = 1.0, int index = 0) {
  const SphereCover::Node& node = cover.nodes[index];
  const double reach = shrink * node.ball.radius + slack;
  if (!((p - node.ball.center.cast<double>()).norm() <= reach)) return false;
  if (node.childCount == 0) return true;
  for (int i = 0; i < node.childCount; ++i) {
    if (covers(cover, p, slack, shrink, node.firstChild + i)) return true;
  }
  return false;
}

}  // namespace swept::test
