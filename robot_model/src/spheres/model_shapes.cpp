// SPDX-License-Identifier: BSD-3-Clause
#include "spheres/model_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace swept::detail {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d poseAt(const JsonValue& value) {
  const std::vector<JsonValue> numbers = value.elements(7);
  const auto number = [&](std::size_t i) { return numbers[i].number(); };
  Eigen::Quaterniond turn(number(6), number(3), number(4), number(5));
  if (!(std::abs(turn.norm() - 1.0) < 0.01)) value.fail("has a quaternion that is no rotation");
  Isometry3d pose(turn.normalized());
  pose.translation() = Vector3d(number(0), number(1), number(2));
  return pose;
}

Shape shapeAt(const JsonValue& value) {
  const JsonValue type = value.at("type");
  const std::string name = type.text();
  const auto size = [&](const char* key) { return value.at(key).notNegative(); };
  if (name == "sphere") return makeSphere(size("radius"));
  if (name == "capsule") return makeCapsule(size("radius"), size("length"));
  if (name == "cylinder") return makeCylinder(size("radius"), size("length"));
  if (name == "box") {
    Vector3d sides;
    const std::vector<JsonValue> sizes = value.at("size").elements(3);
    for (int axis = 0; axis < 3; ++axis)
      sides[axis] = sizes[static_cast<std::size_t>(axis)].notNegative();
    return makeBox(sides);
  }
  if (name != "convex") type.refuse("sphere, box, cylinder, capsule or convex");
  std::vector<Vector3d> vertices;
  for (const JsonValue& vertex : value.at("vertices").elements())
    vertices.push_back(vertex.vector3());
  if (vertices.empty()) value.at("vertices").fail("is empty");
  return ConvexHull::of(vertices);
}

/// A cylinder and the spheres at its ends, as they are written for a capsule.
bool isCapsule(const PosedShape* first) {
  const auto* cylinder = std::get_if<Cylinder>(&first[0].shape);
  if (cylinder == nullptr) return false;
  for (const int end : {-1, 1}) {
    const PosedShape& posed = first[end < 0 ? 1 : 2];
    const auto* sphere = std::get_if<Sphere>(&posed.shape);
    if (sphere == nullptr || sphere->radius != cylinder->radius) return false;
    const Vector3d tip = first[0].body_from_shape * Vector3d(0, 0, end * cylinder->halfLength);
    if (!((posed.body_from_shape.translation() - tip).norm() <= 1e-9)) return false;
  }
  return true;
}

}  // namespace

void refuseShape() {
  throw std::invalid_argument(
      "a model to be written has a shape that is neither sphere, box, cylinder, capsule nor hull");
}

Json shapeJson(const PosedShape& posed) {
  Json json;
  if (const auto* sphere = std::get_if<Sphere>(&posed.shape)) {
    json = {{"type", "sphere"}, {"radius", sphere->radius}};
  } else if (const auto* box = std::get_if<Box>(&posed.shape)) {
    json = {{"type", "box"}, {"size", toJson(Vector3d(2.0 * box->halfExtents))}};
  } else if (const auto* capsule = std::get_if<Capsule>(&posed.shape)) {
    json = {
        {"type", "capsule"}, {"radius", capsule->radius}, {"length", 2.0 * capsule->halfLength}};
  } else if (const auto* cylinder = std::get_if<Cylinder>(&posed.shape)) {
    json = {
        {"type", "cylinder"}, {"radius", cylinder->radius}, {"length", 2.0 * cylinder->halfLength}};
  } else if (const auto* hull = std::get_if<ConvexHull>(&posed.shape)) {
    json = {{"type", "convex"}, {"vertices", Json::array()}, {"faces", Json::array()}};
    for (const Vector3d& vertex : hull->vertices()) json["vertices"].push_back(toJson(vertex));
    for (const Eigen::Vector3i& face : hull->faces())
      json["faces"].push_back({face[0], face[1], face[2]});
  } else {
    refuseShape();
  }
  const Vector3d place = posed.body_from_shape.translation();
  const Eigen::Quaterniond turn(posed.body_from_shape.linear());
  json["pose"] = {place.x(), place.y(), place.z(), turn.x(), turn.y(), turn.z(), turn.w()};
  return json;
}

Json sphereJson(const EnclosingSphere& sphere) {
  return {sphere.center.x(), sphere.center.y(), sphere.center.z(), sphere.radius};
}

void addFigures(Json& entry, const std::string& name,
                const std::vector<LinkSphereReport>& reports) {
  for (const LinkSphereReport& report : reports) {
    if (report.link != name) continue;
    entry["largest_excess"] = finiteOrNull(report.excess.largest);
    entry["largest_excess_seen"] = finiteOrNull(report.excess.largestSeen);
    entry["mean_excess"] = finiteOrNull(report.excess.mean);
    entry["volume_ratio"] = finiteOrNull(report.excess.volumeRatio);
  }
}

PosedShape shapeOf(const JsonValue& value) {
  return {shapeAt(value), poseAt(value.at("pose"))};
}

EnclosingSphere sphereOf(const JsonValue& value) {
  const std::vector<JsonValue> numbers = value.elements(4);
  return {{numbers[0].number(), numbers[1].number(), numbers[2].number()},
          numbers[3].notNegative()};
}

std::vector<PosedShape> withCapsules(const std::vector<PosedShape>& parts) {
  std::vector<PosedShape> shapes;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i + 2 < parts.size() && isCapsule(&parts[i])) {
      const auto& cylinder = std::get<Cylinder>(parts[i].shape);
      shapes.push_back({Capsule{std::max(0.0, cylinder.radius - 2e-9), cylinder.halfLength},
                        parts[i].body_from_shape});
      i += 2;
    } else {
      shapes.push_back(parts[i]);
    }
  }
  return shapes;
}

}  // namespace swept::detail
