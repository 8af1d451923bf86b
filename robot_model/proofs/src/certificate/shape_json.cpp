// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/shape_json.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include "verify/encoding.hpp"

namespace swept {
namespace {

std::string packed(std::span<const Eigen::Vector3d> points) {
  // Three doubles each, without padding.
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  return verify::base64Of(points.empty() ? std::span<const double>()
                                         : std::span(points.front().data(), 3 * points.size()));
}

Json of(const Sphere& shape) {
  return {{"type", "sphere"}, {"radius", shape.radius}};
}
Json of(const Box& shape) {
  return {{"type", "box"}, {"half_extents", toJson(shape.halfExtents)}};
}
Json of(const Cylinder& shape) {
  return {{"type", "cylinder"}, {"radius", shape.radius}, {"half_length", shape.halfLength}};
}
Json of(const Capsule& shape) {
  return {{"type", "capsule"}, {"radius", shape.radius}, {"half_length", shape.halfLength}};
}
Json of(const Cone& shape) {
  return {{"type", "cone"}, {"radius", shape.radius}, {"half_length", shape.halfLength}};
}
Json of(const Ellipsoid& shape) {
  return {{"type", "ellipsoid"}, {"semi_axes", toJson(shape.semiAxes)}};
}
Json of(const ConvexHull& shape) {
  return {{"type", "convex"}, {"vertices", packed(shape.vertices())}, {"error", shape.error()}};
}
Json of(const Triangle& shape) {
  return {{"type", "convex"}, {"vertices", packed(shape.corners)}, {"error", 0.0}};
}
Json of(const Plane& shape) {
  return {{"type", "plane"}, {"normal", toJson(shape.normal)}, {"offset", shape.offset}};
}
Json of(const HalfSpace& shape) {
  return {{"type", "half_space"}, {"normal", toJson(shape.normal)}, {"offset", shape.offset}};
}

Json of(const TriangleMesh& shape) {
  std::vector<std::uint32_t> corners;
  for (const TriangleMesh::Triangle& triangle : shape.triangles())
    for (Eigen::Index k = 0; k < 3; ++k) corners.push_back(static_cast<std::uint32_t>(triangle[k]));
  return {{"type", "mesh"},
          {"vertices", packed(shape.vertices())},
          {"triangles", verify::base64Of(corners)},
          {"solid", shape.interior() == MeshInterior::Solid}};
}

Json of(const PointCloud& shape) {
  Json json = {{"type", "cloud"}, {"points", packed(shape.points())}};
  if (shape.leastRadius() == shape.largestRadius()) {
    json["radii"] = shape.largestRadius();
    return json;
  }
  std::vector<double> radii;
  for (std::size_t i = 0; i < shape.points().size(); ++i) radii.push_back(shape.radius(i));
  json["radii"] = verify::base64Of(radii);
  return json;
}

}  // namespace

Json exactShapeJson(const Shape& shape) {
  return std::visit([](const auto& own) { return of(own); }, shape);
}

}  // namespace swept
