// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "swept/core/shapes.hpp"

/// Pairs of convex shapes near contact, each built from a feature of either shape: a face, an edge
/// or a vertex, the side, the rim or an end. With a gap > 0 the two lie on either side of a slab of
/// that thickness and touch both its planes at points that face each other, so that their distance
/// is the gap; with a gap < 0 they overlap by at most as much.
namespace samples {

using Eigen::Isometry3d;
using Eigen::Vector3d;

struct Feature {
  Vector3d point;   ///< m, on the surface
  Vector3d normal;  ///< unit, in the normal cone there
};

struct Pair {
  swept::Shape a;
  swept::Shape b;
  Isometry3d world_from_a;
  Isometry3d world_from_b;
  Isometry3d a_from_b;
  double gap;  ///< m
};

class Generator {
 public:
  explicit Generator(unsigned seed) : engine_(seed) {}

  /// |gap| is log-uniform in [1e-6, 1e-1] m and negative for every other pair; sizes are 0.1 to
  /// 1 m.
  std::vector<Pair> pairs(const std::string& kindA, const std::string& kindB, std::size_t count) {
    std::vector<Pair> result;
    while (result.size() < count) {
      Pair pair{shape(kindA), shape(kindB), pose(), {}, {}, 0.0};
      pair.gap = std::pow(10.0, uniform(-6.0, -1.0)) * (result.size() % 2 == 0 ? 1.0 : -1.0);
      const Feature a = featureOf(pair.a);
      const Feature b = featureOf(pair.b);
      Isometry3d a_from_b = Isometry3d::Identity();
      a_from_b.linear() =
          (Eigen::Quaterniond(Eigen::AngleAxisd(uniform(0.0, 2.0 * kPi), a.normal)) *
           Eigen::Quaterniond::FromTwoVectors(b.normal, -a.normal))
              .normalized()
              .toRotationMatrix();
      a_from_b.translation() = a.point + pair.gap * a.normal - a_from_b.linear() * b.point;
      pair.a_from_b = a_from_b;
      pair.world_from_b = pair.world_from_a * a_from_b;
      result.push_back(std::move(pair));
    }
    return result;
  }

  swept::Shape shape(const std::string& kind) {
    const double r = uniform(0.05, 0.5);
    const double h = uniform(0.05, 0.5);
    if (kind == "sphere") return swept::Sphere{r};
    if (kind == "box") return swept::Box{{r, h, uniform(0.05, 0.5)}};
    if (kind == "cylinder") return swept::Cylinder{r, h};
    if (kind == "capsule") return swept::Capsule{r, h};
    if (kind == "cone") return swept::Cone{r, h};
    if (kind == "ellipsoid") return swept::Ellipsoid{{r, h, uniform(0.05, 0.5)}};
    if (kind == "triangle") return swept::Triangle{{point(0.5), point(0.5), point(0.5)}};
    if (kind == "plane") return swept::Plane{direction(), uniform(-0.5, 0.5)};
    if (kind == "halfspace") return swept::HalfSpace{direction(), uniform(-0.5, 0.5)};
    std::vector<Vector3d> points;
    const Vector3d semi(r, h, uniform(0.05, 0.5));
    for (int i = 0; i < 32; ++i) points.push_back(semi.cwiseProduct(direction()));
    return swept::ConvexHull::of(points);
  }

 private:
  static constexpr double kPi = 3.14159265358979323846;

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double weight() { return -std::log(1.0 - uniform(0.0, 1.0)); }
  Vector3d point(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  Vector3d direction() {
    std::normal_distribution<double> normal;
    return Vector3d(normal(engine_), normal(engine_), normal(engine_)).normalized();
  }
  Isometry3d pose() {
    Isometry3d result = Isometry3d::Identity();
    result.linear() = Eigen::Quaterniond::FromTwoVectors(direction(), direction())
                          .normalized()
                          .toRotationMatrix();
    result.translation() = point(1.0);
    return result;
  }

  Feature featureOf(const swept::Shape& shape) {
    return std::visit([this](const auto& body) { return feature(body); }, shape);
  }

  Feature feature(const swept::Sphere& s) {
    const Vector3d n = direction();
    return {s.radius * n, n};
  }
  Feature feature(const swept::Ellipsoid& e) {
    const Vector3d n = direction();
    const Vector3d stretched = e.semiAxes.cwiseProduct(n);
    return {e.semiAxes.cwiseProduct(stretched) / stretched.norm(), n};
  }
  Feature feature(const swept::Box& box) {
    Feature f{Vector3d::Zero(), Vector3d::Zero()};
    const int fixed = 1 + static_cast<int>(uniform(0.0, 3.0));  // 1: face, 2: edge, 3: vertex
    const int first = static_cast<int>(uniform(0.0, 3.0));
    for (int k = 0; k < 3; ++k) {
      const int i = (first + k) % 3;
      const double sign = uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
      f.point[i] =
          k < fixed ? sign * box.halfExtents[i] : uniform(-box.halfExtents[i], box.halfExtents[i]);
      if (k < fixed) f.normal[i] = sign * weight();
    }
    f.normal.normalize();
    return f;
  }
  Feature feature(const swept::Cylinder& c) {
    const double phi = uniform(0.0, 2.0 * kPi);
    const double top = uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
    const Vector3d radial(std::cos(phi), std::sin(phi), 0.0);
    const double kind = uniform(0.0, 3.0);
    if (kind < 1.0) {
      return {c.radius * radial + uniform(-c.halfLength, c.halfLength) * Vector3d::UnitZ(), radial};
    }
    const double share = kind < 2.0 ? std::sqrt(uniform(0.0, 1.0)) : 1.0;
    const double tilt = kind < 2.0 ? 0.5 * kPi : uniform(0.0, 0.5 * kPi);
    return {share * c.radius * radial + top * c.halfLength * Vector3d::UnitZ(),
            std::cos(tilt) * radial + top * std::sin(tilt) * Vector3d::UnitZ()};
  }
  Feature feature(const swept::Capsule& c) {
    const Vector3d n = direction();
    if (uniform(0.0, 1.0) < 0.5) {
      return {c.radius * n + std::copysign(c.halfLength, n.z()) * Vector3d::UnitZ(), n};
    }
    const Vector3d side = Vector3d(n.x(), n.y(), 0.0).normalized();
    return {c.radius * side + uniform(-c.halfLength, c.halfLength) * Vector3d::UnitZ(), side};
  }
  Feature feature(const swept::Cone& c) {
    const double phi = uniform(0.0, 2.0 * kPi);
    const Vector3d radial(std::cos(phi), std::sin(phi), 0.0);
    const Vector3d side = (2.0 * c.halfLength * radial + c.radius * Vector3d::UnitZ()).normalized();
    const Vector3d rim = c.radius * radial - c.halfLength * Vector3d::UnitZ();
    const Vector3d apex = c.halfLength * Vector3d::UnitZ();
    const double kind = uniform(0.0, 4.0);
    if (kind < 1.0) return {rim + uniform(0.0, 1.0) * (apex - rim), side};
    if (kind < 2.0) {
      const double share = std::sqrt(uniform(0.0, 1.0));
      return {share * c.radius * radial - c.halfLength * Vector3d::UnitZ(), -Vector3d::UnitZ()};
    }
    if (kind < 3.0) return {rim, (weight() * side - weight() * Vector3d::UnitZ()).normalized()};
    return {apex, (weight() * side + weight() * Vector3d::UnitZ()).normalized()};
  }
  Feature feature(const swept::Triangle& t) {
    const Vector3d n = (t.corners[1] - t.corners[0]).cross(t.corners[2] - t.corners[0]);
    const Vector3d up = (uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0) * n.normalized();
    return onTriangle(t.corners, up, up, up);
  }
  Feature feature(const swept::ConvexHull& hull) {
    const std::size_t face =
        static_cast<std::size_t>(uniform(0.0, static_cast<double>(hull.faces().size())));
    std::array<Vector3d, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = hull.vertices()[hull.faces()[face][k]];
    // Faces across the first edge and around the first vertex: for the latter, all share in.
    Vector3d across = normalOf(hull, face);
    Vector3d around = Vector3d::Zero();
    for (std::size_t i = 0; i < hull.faces().size(); ++i) {
      const Eigen::Vector3i& f = hull.faces()[i];
      const bool first = (f.array() == hull.faces()[face][0]).any();
      const bool second = (f.array() == hull.faces()[face][1]).any();
      if (first && second && i != face) across = normalOf(hull, i);
      if (first) around += weight() * normalOf(hull, i);
    }
    return onTriangle(corners, normalOf(hull, face), across, around.normalized());
  }
  static Vector3d normalOf(const swept::ConvexHull& hull, std::size_t face) {
    const Eigen::Vector3i& f = hull.faces()[face];
    const auto& v = hull.vertices();
    return (v[f[1]] - v[f[0]]).cross(v[f[2]] - v[f[0]]).normalized();
  }
  /// A point inside, on the first edge or at the first corner; `across` is the normal of the face
  /// beyond the first edge, `corner` one in the normal cone of the first corner.
  Feature onTriangle(const std::array<Vector3d, 3>& c, const Vector3d& normal,
                     const Vector3d& across, const Vector3d& corner) {
    const double kind = uniform(0.0, 3.0);
    if (kind < 1.0) {
      const double u = weight();
      const double v = weight();
      const double w = weight();
      return {(u * c[0] + v * c[1] + w * c[2]) / (u + v + w), normal};
    }
    if (kind < 2.0) {
      return {c[0] + uniform(0.0, 1.0) * (c[1] - c[0]),
              (weight() * normal + weight() * across).normalized()};
    }
    return {c[0], corner};
  }
  Feature feature(const swept::Plane& p) {
    const double sign = uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
    return {onPlane(p.normal, p.offset), sign * p.normal};
  }
  Feature feature(const swept::HalfSpace& p) { return {onPlane(p.normal, p.offset), p.normal}; }
  Vector3d onPlane(const Vector3d& normal, double offset) {
    return offset * normal + uniform(-0.5, 0.5) * normal.unitOrthogonal();
  }
  /// Meshes and clouds are not convex.
  template <typename Pieces>
  Feature feature(const Pieces&) {
    throw std::invalid_argument("no features");
  }

  std::mt19937 engine_;
};

}  // namespace samples
