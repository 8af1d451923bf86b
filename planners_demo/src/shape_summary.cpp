// SPDX-License-Identifier: BSD-3-Clause
#include "shape_summary.hpp"

#include <variant>

namespace swept {
namespace {

struct Text {
  std::string operator()(const Sphere& sphere) const {
    return "sphere of radius " + shortNumber(sphere.radius) + " m";
  }
  std::string operator()(const Box& box) const {
    const Eigen::Vector3d size = 2.0 * box.halfExtents;
    return "box " + shortNumber(size.x()) + " x " + shortNumber(size.y()) + " x " +
           shortNumber(size.z()) + " m";
  }
  std::string operator()(const Cylinder& cylinder) const {
    return "cylinder of radius " + shortNumber(cylinder.radius) + " m, length " +
           shortNumber(2.0 * cylinder.halfLength) + " m";
  }
  std::string operator()(const Capsule& capsule) const {
    return "capsule of radius " + shortNumber(capsule.radius) + " m, segment " +
           shortNumber(2.0 * capsule.halfLength) + " m";
  }
  std::string operator()(const ConvexHull& hull) const {
    return "convex hull of " + std::to_string(hull.vertices().size()) + " points";
  }
  std::string operator()(const TriangleMesh& mesh) const {
    return "mesh of " + std::to_string(mesh.triangles().size()) + " triangles, " +
           (mesh.isClosed() ? "closed" : "open") + ", hull of " +
           std::to_string(mesh.hull().vertices().size()) + " points";
  }
};

struct Facts {
  Json operator()(const Sphere& sphere) const {
    return {{"kind", "sphere"}, {"radius", sphere.radius}};
  }
  Json operator()(const Box& box) const {
    return {{"kind", "box"}, {"size", toJson(Eigen::Vector3d(2.0 * box.halfExtents))}};
  }
  Json operator()(const Cylinder& cylinder) const {
    return {
        {"kind", "cylinder"}, {"radius", cylinder.radius}, {"length", 2.0 * cylinder.halfLength}};
  }
  Json operator()(const Capsule& capsule) const {
    return {{"kind", "capsule"},
            {"radius", capsule.radius},
            {"segment_length", 2.0 * capsule.halfLength}};
  }
  Json operator()(const ConvexHull& hull) const {
    return {{"kind", "convex hull"}, {"hull_points", hull.vertices().size()}};
  }
  Json operator()(const TriangleMesh& mesh) const {
    return {{"kind", "mesh"},
            {"triangles", mesh.triangles().size()},
            {"closed", mesh.isClosed()},
            {"hull_points", mesh.hull().vertices().size()}};
  }
};

}  // namespace

std::string shapeText(const Shape& shape) {
  return std::visit(Text{}, shape);
}

Json shapeJson(const Shape& shape) {
  return std::visit(Facts{}, shape);
}

}  // namespace swept
