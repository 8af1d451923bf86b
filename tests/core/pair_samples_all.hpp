// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "mesh_samples.hpp"
#include "shape_oracle.hpp"

/// Pairs of every two kinds of shapes, ordinary ones and degenerate ones, placed on either side of
/// a slab: with a gap >= 0 that is their distance, with a gap < 0 they overlap by at most as much.
namespace samples {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using reference::Random;

/// In the order of the variant.
inline constexpr std::array kNames{"Sphere", "Box",       "Cylinder", "Capsule",
                                   "Cone",   "Ellipsoid", "Hull",     "Triangle",
                                   "Plane",  "HalfSpace", "Mesh",     "Cloud"};
static_assert(std::variant_size_v<swept::Shape> == kNames.size(),
              "a new shape needs samples, and so do its pairs");

enum class Form {
  Ordinary,
  Flat,     ///< without extent in some direction
  Slender,  ///< one size a hundred thousandth of the others
  Small,    ///< all sizes are
};
inline constexpr std::array kForms{Form::Ordinary, Form::Flat, Form::Slender, Form::Small};

struct Pair {
  swept::Shape a;
  swept::Shape b;
  Isometry3d a_from_b;
  double gap;            ///< m
  bool ordinary;         ///< both
  bool parallel = true;  ///< false: planes and half-spaces that cross
};

class Sampler {
 public:
  explicit Sampler(unsigned seed) : random(seed) {}

  Pair pair(std::size_t kindA, std::size_t kindB, int i) {
    const Form formA = i % 2 == 0 ? Form::Ordinary : pick();
    const Form formB = i % 2 == 0 ? Form::Ordinary : pick();
    Pair pair{shape(kindA, formA), shape(kindB, formB), Isometry3d::Identity(), gap(i), false};
    pair.ordinary = formA == Form::Ordinary && formB == Form::Ordinary;
    Vector3d n = random.uniform(0.0, 1.0) < 0.2 ? axis() : random.direction();
    if (const Vector3d* normal = oracle::flatNormal(pair.a)) n = *normal;
    Matrix3d r = rotation();
    const Vector3d* normalB = oracle::flatNormal(pair.b);
    if (normalB != nullptr) {
      r = Eigen::Quaterniond::FromTwoVectors(*normalB, -n).normalized().toRotationMatrix();
      if (oracle::flatNormal(pair.a) != nullptr && i % 4 == 3) {
        r = rotation();
        pair.parallel = ((r * *normalB).cross(n)).norm() < 1e-12;
      }
    }
    pair.a_from_b.linear() = r;
    pair.a_from_b.translation() = oracle::support(pair.a, n) + pair.gap * n -
                                  r * oracle::support(pair.b, -(r.transpose() * n));
    return pair;
  }

  swept::Shape shape(std::size_t kind, Form form) {
    Vector3d size{random.uniform(0.05, 0.5), random.uniform(0.05, 0.5), random.uniform(0.05, 0.5)};
    if (form == Form::Small) size *= 1e-5;
    if (form == Form::Flat || form == Form::Slender) {
      const int many = random.uniform(0.0, 1.0) < 0.7 ? 1 : 2;
      for (int k = 0; k < many; ++k) {
        size[static_cast<int>(random.uniform(0.0, 3.0))] *= form == Form::Flat ? 0.0 : 1e-5;
      }
    }
    switch (kind) {
      case 0:
        return swept::Sphere{size.x()};
      case 1:
        return swept::Box{size};
      case 2:
        return swept::Cylinder{size.x(), size.y()};
      case 3:
        return swept::Capsule{size.x(), size.y()};
      case 4:
        return swept::Cone{size.x(), size.y()};
      case 5:
        return swept::Ellipsoid{size};
      case 6:
        return swept::ConvexHull::of(cloud(size, 20));
      case 7: {
        const auto corners = cloud(size, 3);
        return swept::Triangle{{corners[0], corners[1], corners[2]}};
      }
      case 8:
        return swept::Plane{random.direction(), random.uniform(-0.5, 0.5)};
      case 9:
        return swept::HalfSpace{random.direction(), random.uniform(-0.5, 0.5)};
      case 10:
        return form == Form::Small ? box(size) : hollow();
      default: {
        const auto points = cloud(size, 12);
        return swept::PointCloud::build(points, form == Form::Flat ? 0.0 : 0.1 * size.maxCoeff());
      }
    }
  }

  Matrix3d rotation() {
    if (random.uniform(0.0, 1.0) < 0.7) return random.pose(1.0).linear();
    // One of the cube's, and sometimes next to it.
    Matrix3d r = Matrix3d::Zero();
    const int shift = static_cast<int>(random.uniform(0.0, 3.0));
    for (int k = 0; k < 3; ++k) r((k + shift) % 3, k) = 1.0;
    if (random.uniform(0.0, 1.0) < 0.5) r.row(0) *= -1.0, r.row(1) *= -1.0;
    if (random.uniform(0.0, 1.0) < 0.5) {
      const double tilt = std::pow(10.0, random.uniform(-14.0, -4.0));
      r = Eigen::AngleAxisd(tilt, random.direction()).toRotationMatrix() * r;
    }
    return r;
  }

  Random random;

 private:
  Form pick() { return kForms[static_cast<std::size_t>(random.uniform(0.0, 4.0))]; }
  Vector3d axis() {
    return (random.uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0) *
           Vector3d::Unit(static_cast<int>(random.uniform(0.0, 3.0)));
  }
  /// m. Apart, touching, in shallow and in deep overlap.
  double gap(int i) {
    const double size = std::pow(10.0, random.uniform(-9.0, -0.5));
    switch (i % 5) {
      case 0:
      case 1:
        return size;
      case 2:
        return 0.0;
      case 3:
        return -size;
      default:
        return -random.uniform(0.01, 0.5);
    }
  }
  std::vector<Vector3d> cloud(const Vector3d& size, int count) {
    std::vector<Vector3d> points;
    for (int i = 0; i < count; ++i) points.push_back(size.cwiseProduct(random.direction()));
    return points;
  }
  static swept::Shape box(const Vector3d& half) {
    const swept::test::Soup soup = swept::test::boxSoup(-half, half);
    return swept::TriangleMesh::build(soup.vertices, soup.triangles);
  }
  /// A torus: closed and not convex.
  swept::Shape hollow() {
    const double major = random.uniform(0.25, 0.35);
    const swept::test::Soup soup = swept::test::torusSoup(8, 6, major, random.uniform(0.05, 0.2));
    return swept::TriangleMesh::build(soup.vertices, soup.triangles);
  }
};

}  // namespace samples
