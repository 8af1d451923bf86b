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
#include "reference_distance.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/sphere_cover.hpp"

/// Points of shapes and distances from them, in closed form or by trying every triangle, for
/// judging covers.
namespace swept::test {

/// Whether a mesh whose components are all oriented the same way contains a point.
inline bool isInside(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  return mesh.isClosed() && mesh.interior() == MeshInterior::Solid &&
         std::abs(reference::windingNumber(
             reference::trianglesOf(mesh.vertices(), mesh.triangles()), point)) > 0.5;
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
    return std::max(0.0, reference::pointSegment(p, -end, end) - s.radius);
  }
  double operator()(const Cone& s) const {
    const double radial = p.head<2>().norm();
    const double height = 2.0 * s.halfLength;
    const double above = p.z() + s.halfLength;
    if (above >= 0.0 && radial * height <= s.radius * (height - above)) return 0.0;
    const Eigen::Vector3d end(0.0, 0.0, s.halfLength);
    return reference::pointTriangle({radial, 0.0, p.z()},
                                    {-end, Eigen::Vector3d(s.radius, 0.0, -s.halfLength), end});
  }
  double operator()(const Triangle& s) const { return reference::pointTriangle(p, s.corners); }
  double operator()(const TriangleMesh& s) const {
    if (isInside(s, p)) return 0.0;
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& t : reference::trianglesOf(s.vertices(), s.triangles()))
      nearest = std::min(nearest, reference::pointTriangle(p, t));
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
      const Eigen::Vector3d at{oftenAtEnd(), oftenAtEnd(), oftenAtEnd()};
      return Eigen::Vector3d(s.halfExtents.cwiseProduct(at));
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
      const Eigen::Vector3d inTip = s.radius * inBall();
      return Eigen::Vector3d(inTip + s.halfLength * oftenAtEnd() * Eigen::Vector3d::UnitZ());
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
      const Eigen::Vector3d a = vertex(), b = vertex(), c = vertex();
      const Eigen::Vector3d onFace = onTriangle(a, b, c);
      const double inwards = uniform(random_, 0.0, 1.0);
      points.push_back(onFace + inwards * (vertex() - onFace));
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
      const Eigen::Vector3d unit{uniform(random_, 0.0, 1.0), uniform(random_, 0.0, 1.0),
                                 uniform(random_, 0.0, 1.0)};
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
    const double reach = std::min(1.0, uniform(random_, 0.2, 1.6));
    return reach * unitVector(random_);
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
