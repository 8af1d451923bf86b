// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "certificate/read_checker.hpp"
#include "swept/core/point_cloud.hpp"
#include "swept/core/triangle_mesh.hpp"
#include "verify/encoding.hpp"
#include "verify/model.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;
using verify::at;
using verify::Refusal;

const std::string kWhere = "shapes";

double lengthOf(const Json& json, const char* key) {
  return verify::readNumber(at(json, key, kWhere), kWhere + ", " + key);
}

Vector3d vectorOf(const Json& json, const char* key) {
  return verify::readVector(at(json, key, kWhere), kWhere + ", " + key);
}

std::string packedText(const Json& json, const char* key) {
  const Json& text = at(json, key, kWhere);
  if (!text.is_string()) throw Refusal(kWhere + ": " + key + " is not a text");
  return text.get<std::string>();
}

std::vector<Vector3d> pointsOf(const Json& json, const char* key) {
  const std::vector<double> numbers = verify::doublesOf(packedText(json, key), kWhere);
  if (numbers.size() % 3 != 0) throw Refusal(kWhere + ": " + key + " are not points");
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < numbers.size(); i += 3)
    points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  return points;
}

Shape meshOf(const Json& json) {
  const std::vector<std::uint32_t> corners =
      verify::integersOf(packedText(json, "triangles"), kWhere);
  if (corners.size() % 3 != 0) throw Refusal(kWhere + ": triangles have not three corners");
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::size_t i = 0; i < corners.size(); i += 3)
    triangles.emplace_back(static_cast<int>(corners[i]), static_cast<int>(corners[i + 1]),
                           static_cast<int>(corners[i + 2]));
  return TriangleMesh::build(
      pointsOf(json, "vertices"), triangles,
      at(json, "solid", kWhere) == true ? MeshInterior::Solid : MeshInterior::Surface);
}

Shape cloudOf(const Json& json) {
  const Json& radii = at(json, "radii", kWhere);
  if (radii.is_number())
    return PointCloud::build(pointsOf(json, "points"), verify::readNumber(radii, kWhere));
  return PointCloud::build(pointsOf(json, "points"),
                           verify::doublesOf(packedText(json, "radii"), kWhere));
}

Shape ofType(const std::string& type, const Json& json) {
  if (type == "sphere") return Sphere{lengthOf(json, "radius")};
  if (type == "box") return Box{vectorOf(json, "half_extents")};
  if (type == "cylinder") return Cylinder{lengthOf(json, "radius"), lengthOf(json, "half_length")};
  if (type == "capsule") return Capsule{lengthOf(json, "radius"), lengthOf(json, "half_length")};
  if (type == "cone") return Cone{lengthOf(json, "radius"), lengthOf(json, "half_length")};
  if (type == "ellipsoid") return Ellipsoid{vectorOf(json, "semi_axes")};
  if (type == "convex") return ConvexHull::of(pointsOf(json, "vertices"));
  if (type == "plane") return Plane{vectorOf(json, "normal"), lengthOf(json, "offset")};
  if (type == "half_space") return HalfSpace{vectorOf(json, "normal"), lengthOf(json, "offset")};
  if (type == "mesh") return meshOf(json);
  if (type == "cloud") return cloudOf(json);
  throw Refusal(kWhere + ": no type of shape '" + type + "'");
}

}  // namespace

CheckerReader::ReadShape& CheckerReader::shapeOf(const Json& json) {
  Json own = json;
  own.erase("pose");
  const auto [entry, isNew] = shapes_.try_emplace(own.dump());
  if (isNew) {
    entry->second.shape = ofType(packedText(json, "type"), json);
    entry->second.error = json.value("error", 0.0);
  }
  return entry->second;
}

}  // namespace swept
