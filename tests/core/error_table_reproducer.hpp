// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>
#include <variant>
#include <vector>

#include "swept/core/shapes.hpp"

namespace error_table {

/// C++ that makes the pair again, to the last bit.
class Reproducer {
 public:
  static std::string of(const swept::Shape& a, const swept::Shape& b,
                        const Eigen::Isometry3d& pose) {
    std::string text = "  const Shape a = " + shape(a) + ";\n  const Shape b = " + shape(b) +
                       ";\n  Eigen::Isometry3d pose;\n  pose.matrix() <<";
    for (int i = 0; i < 16; ++i) {
      text += (i ? ", " : " ") + number(pose.matrix()(i / 4, i % 4));
    }
    return text + ";\n";
  }

  static std::string numbers(const std::vector<double>& values) {
    std::string text = "{";
    for (const double value : values) text += number(value) + ", ";
    return text + "}";
  }
  static std::string number(double x) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.17g", x);
    return buffer;
  }

 private:
  static std::string vector(const Eigen::Vector3d& v) {
    return "Vector3d(" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + ")";
  }
  template <class Range>
  static std::string list(const Range& points) {
    std::string text = "{";
    for (const auto& p : points) text += (text.size() > 1 ? ", " : "") + vector(p);
    return text + "}";
  }
  static std::string flat(const std::string& name, const Eigen::Vector3d& normal, double offset) {
    return name + "{" + vector(normal) + ", " + number(offset) + "}";
  }
  static std::string round(const std::string& name, double radius, double halfLength) {
    return name + "{" + number(radius) + ", " + number(halfLength) + "}";
  }

  struct Printer {
    std::string operator()(const swept::Sphere& s) const {
      return "Sphere{" + number(s.radius) + "}";
    }
    std::string operator()(const swept::Box& s) const {
      return "Box{" + vector(s.halfExtents) + "}";
    }
    std::string operator()(const swept::Cylinder& s) const {
      return round("Cylinder", s.radius, s.halfLength);
    }
    std::string operator()(const swept::Capsule& s) const {
      return round("Capsule", s.radius, s.halfLength);
    }
    std::string operator()(const swept::Cone& s) const {
      return round("Cone", s.radius, s.halfLength);
    }
    std::string operator()(const swept::Ellipsoid& s) const {
      return "Ellipsoid{" + vector(s.semiAxes) + "}";
    }
    std::string operator()(const swept::ConvexHull& s) const {
      return "ConvexHull::of(std::vector<Vector3d>" + list(s.vertices()) + ")";
    }
    std::string operator()(const swept::Triangle& s) const {
      return "Triangle{{" + list(s.corners).substr(1) + "}";
    }
    std::string operator()(const swept::Plane& s) const {
      return flat("Plane", s.normal, s.offset);
    }
    std::string operator()(const swept::HalfSpace& s) const {
      return flat("HalfSpace", s.normal, s.offset);
    }
    std::string operator()(const swept::TriangleMesh& s) const {
      std::string text = "TriangleMesh::build(std::vector<Vector3d>" + list(s.vertices()) +
                         ", std::vector<Eigen::Vector3i>{";
      for (const Eigen::Vector3i& t : s.triangles()) {
        text += std::to_string(t[0]).insert(0, 1, '{') + ", " + std::to_string(t[1]) + ", " +
                std::to_string(t[2]) + "}, ";
      }
      return text + "})";
    }
    std::string operator()(const swept::PointCloud& s) const {
      std::vector<double> radii;
      for (std::size_t i = 0; i < s.points().size(); ++i) radii.push_back(s.radius(i));
      return "PointCloud::build(std::vector<Vector3d>" + list(s.points()) + ", " +
             "std::vector<double>" + numbers(radii) + ")";
    }
  };

  static std::string shape(const swept::Shape& s) { return std::visit(Printer{}, s); }
};

}  // namespace error_table
