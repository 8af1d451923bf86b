// SPDX-License-Identifier: BSD-3-Clause
// Sweeps as C++, to be pasted where one is looked into.
#include <cstdio>

#include "sweep.hpp"

namespace sweeps {
namespace {

std::string number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

std::string vector(const Vector3d& v) {
  return std::string("{") + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "}";
}

std::string vectors(const std::vector<Vector3d>& all) {
  std::string text = "std::vector<Eigen::Vector3d>{";
  for (const Vector3d& v : all) text += vector(v) + ", ";
  return text + "}";
}

std::string matrix(const Matrix3d& m) {
  std::string text = "(Eigen::Matrix3d() << ";
  for (int i = 0; i < 9; ++i) text += number(m(i / 3, i % 3)) + (i < 8 ? ", " : "");
  return text + ").finished()";
}

std::string pose(const Isometry3d& p) {
  return std::string("Eigen::Isometry3d(Eigen::Translation3d(Eigen::Vector3d") +
         vector(p.translation()) + ")) * Eigen::Isometry3d(Eigen::Affine3d(" + matrix(p.linear()) +
         ").matrix())";
}

struct ShapeCode {
  std::string operator()(const swept::Sphere& s) const {
    return std::string("swept::Sphere{") + number(s.radius) + "}";
  }
  std::string operator()(const swept::Box& s) const {
    return std::string("swept::Box{") + vector(s.halfExtents) + "}";
  }
  std::string operator()(const swept::Cylinder& s) const {
    return std::string("swept::Cylinder{") + number(s.radius) + ", " + number(s.halfLength) + "}";
  }
  std::string operator()(const swept::Capsule& s) const {
    return std::string("swept::Capsule{") + number(s.radius) + ", " + number(s.halfLength) + "}";
  }
  std::string operator()(const swept::Cone& s) const {
    return std::string("swept::Cone{") + number(s.radius) + ", " + number(s.halfLength) + "}";
  }
  std::string operator()(const swept::Ellipsoid& s) const {
    return std::string("swept::Ellipsoid{") + vector(s.semiAxes) + "}";
  }
  std::string operator()(const swept::ConvexHull& s) const {
    return std::string("swept::ConvexHull::of(") + vectors(s.vertices()) + ")";
  }
  std::string operator()(const swept::Triangle& s) const {
    return std::string("swept::Triangle{{{") + vector(s.corners[0]) + ", " + vector(s.corners[1]) +
           ", " + vector(s.corners[2]) + "}}}";
  }
  std::string operator()(const swept::Plane& s) const {
    return std::string("swept::Plane{") + vector(s.normal) + ", " + number(s.offset) + "}";
  }
  std::string operator()(const swept::HalfSpace& s) const {
    return std::string("swept::HalfSpace{") + vector(s.normal) + ", " + number(s.offset) + "}";
  }
  std::string operator()(const swept::TriangleMesh& s) const {
    std::string triangles = "std::vector<Eigen::Vector3i>{";
    for (const Eigen::Vector3i& t : s.triangles()) {
      triangles += std::string("{") + std::to_string(t[0]) + ", " + std::to_string(t[1]) + ", " +
                   std::to_string(t[2]) + "}, ";
    }
    const bool solid = s.interior() == swept::MeshInterior::Solid;
    return std::string("swept::TriangleMesh::build(") + vectors(s.vertices()) + ", " + triangles +
           "}, swept::MeshInterior::" + (solid ? "Solid" : "Surface") + ", 0.0)";
  }
  std::string operator()(const swept::PointCloud& s) const {
    std::string radii = "std::vector<double>{";
    for (std::size_t i = 0; i < s.points().size(); ++i) radii += number(s.radius(i)) + ", ";
    return std::string("swept::PointCloud::build(") + vectors(s.points()) + ", " + radii + "})";
  }
};

}  // namespace

std::string Body::code() const {
  return std::visit(ShapeCode{}, shape);
}

std::string Path::code() const {
  std::string poses = "std::vector<swept::ControlPose>{";
  for (const swept::ControlPose& c : control) {
    poses += std::string("{") + vector(c.position) + ", " + vector(c.rotation) + "}, ";
  }
  const std::string splined = std::string("(") + matrix(start.linear()) + ", " + poses + "})";
  const std::string from = std::string("(") + pose(start);
  switch (kind) {
    case PathKind::Still:
      return std::string("swept::UniformMotion::still") + from + ")";
    case PathKind::Translation:
      return std::string("swept::UniformMotion::translation") + from + ", " + vector(move) + ")";
    case PathKind::Interpolation:
      return std::string("swept::UniformMotion::interpolation") + from + ", " + pose(end) + ", " +
             vector(reference) + ")";
    case PathKind::Screw:
      return std::string("swept::UniformMotion::screw") + from + ", " + pose(end) + ")";
    case PathKind::Turning:
      return std::string("swept::UniformMotion::turning") + from + ", " + vector(turn) + ", " +
             vector(move) + ", " + vector(reference) + ")";
    case PathKind::Bezier:
      return std::string("swept::SplineMotion::bezier") + splined;
    case PathKind::Cubic:
      break;
  }
  return std::string("swept::SplineMotion::uniformCubic") + splined;
}

std::string Sweep::code() const {
  return std::string("  const swept::Shape a = ") + a.code() +
         ";\n  const swept::Shape b = " + b.code() + ";\n  const auto motionA = " + pathA.code() +
         ";\n  const auto motionB = " + pathB.code() +
         ";\n  const auto result = swept::continuousCollide(a, motionA, b, motionB, {.margin = " +
         number(options.margin) + ", .tolerance = " + number(options.tolerance) +
         ", .timeTolerance = " + number(options.timeTolerance) +
         ", .maxIntervals = " + std::to_string(options.maxIntervals) + "});\n";
}

}  // namespace sweeps
