// SPDX-License-Identifier: BSD-3-Clause
#include "output/shape_summary.hpp"

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
  std::string operator()(const Cone& cone) const {
    return "cone of radius " + shortNumber(cone.radius) + " m, height " +
           shortNumber(2.0 * cone.halfLength) + " m";
  }
  std::string operator()(const Ellipsoid& ellipsoid) const {
    const Eigen::Vector3d& axes = ellipsoid.semiAxes;
    return "ellipsoid of semi-axes " + shortNumber(axes.x()) + ", " + shortNumber(axes.y()) + ", " +
           shortNumber(axes.z()) + " m";
  }
  std::string operator()(const Triangle&) const { return "triangle"; }
  std::string operator()(const Plane& plane) const { return "plane" + equation(plane, " = "); }
  std::string operator()(const HalfSpace& halfSpace) const {
    return "half-space" + equation(halfSpace, " <= ");
  }
  std::string operator()(const ConvexHull& hull) const {
    return "convex hull of " + std::to_string(hull.vertices().size()) + " points";
  }
  std::string operator()(const TriangleMesh& mesh) const {
    return "mesh of " + std::to_string(mesh.triangles().size()) + " triangles, " +
           (mesh.isClosed() ? "closed" : "open") + cracks(mesh.report()) + ", hull of " +
           std::to_string(mesh.hull().vertices().size()) + " points";
  }
  std::string operator()(const PointCloud& cloud) const {
    const std::string largest = shortNumber(cloud.largestRadius());
    const std::string text = "cloud of " + std::to_string(cloud.points().size()) + " points of ";
    if (cloud.leastRadius() == cloud.largestRadius()) return text + "radius " + largest + " m";
    return text + "radii " + shortNumber(cloud.leastRadius()) + " to " + largest + " m";
  }

 private:
  static std::string cracks(const MeshReport& report) {
    if (report.cracksFilled == 0) return {};
    if (report.largestCrack == 0.0) return " (corners on edges joined)";
    return " (cracks of up to " + shortNumber(report.largestCrack) + " m filled)";
  }
  template <class Flat>
  static std::string equation(const Flat& flat, const char* relation) {
    const Eigen::Vector3d& n = flat.normal;
    return " (" + shortNumber(n.x()) + ", " + shortNumber(n.y()) + ", " + shortNumber(n.z()) +
           ") . x" + relation + shortNumber(flat.offset) + " m";
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
  Json operator()(const Cone& cone) const {
    return {{"kind", "cone"}, {"radius", cone.radius}, {"height", 2.0 * cone.halfLength}};
  }
  Json operator()(const Ellipsoid& ellipsoid) const {
    return {{"kind", "ellipsoid"}, {"semi_axes", toJson(ellipsoid.semiAxes)}};
  }
  Json operator()(const Triangle& triangle) const {
    Json corners = Json::array();
    for (const Eigen::Vector3d& corner : triangle.corners) corners.push_back(toJson(corner));
    return {{"kind", "triangle"}, {"corners", std::move(corners)}};
  }
  Json operator()(const Plane& plane) const {
    return {{"kind", "plane"}, {"normal", toJson(plane.normal)}, {"offset", plane.offset}};
  }
  Json operator()(const HalfSpace& halfSpace) const {
    return {
        {"kind", "half-space"}, {"normal", toJson(halfSpace.normal)}, {"offset", halfSpace.offset}};
  }
  Json operator()(const ConvexHull& hull) const {
    return {{"kind", "convex hull"}, {"hull_points", hull.vertices().size()}};
  }
  Json operator()(const TriangleMesh& mesh) const {
    Json facts = {{"kind", "mesh"},
                  {"triangles", mesh.triangles().size()},
                  {"closed", mesh.isClosed()},
                  {"hull_points", mesh.hull().vertices().size()}};
    if (mesh.report().cracksFilled > 0) facts["largest_crack_filled"] = mesh.report().largestCrack;
    return facts;
  }
  Json operator()(const PointCloud& cloud) const {
    return {{"kind", "point cloud"},
            {"points", cloud.points().size()},
            {"least_radius", cloud.leastRadius()},
            {"largest_radius", cloud.largestRadius()}};
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
