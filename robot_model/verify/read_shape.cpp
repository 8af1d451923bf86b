// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

#include "encoding.hpp"
#include "model.hpp"
#include "rounding.hpp"

namespace swept::verify {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// m, 0 or more.
double readSize(const Json& json, const char* key, const std::string& where) {
  const double size = readNumber(at(json, key, where), where + ", " + key);
  if (!(size >= 0.0)) throw Refusal(where + ": " + key + " is negative");
  return size;
}

std::vector<Vector3d> readPoints(const Json& json, const std::string& where) {
  if (!json.is_string()) throw Refusal(where + " is not a base64 text");
  const std::vector<double> numbers = doublesOf(json.get<std::string>(), where);
  if (numbers.size() % 3 != 0) throw Refusal(where + " has no three numbers for each point");
  std::vector<Vector3d> points(numbers.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = Vector3d(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
  return points;
}

/// m. What coordinates in the frame of the body are made of, where those in the shape's are up to
/// `local`. Either may take back most of the other.
double sizeIn(const Isometry3d& frame, double local, const std::string& where) {
  const double size = frame.translation().norm() + local;
  if (!(size <= kFarthest)) throw Refusal(where + ": it reaches farther than 1e150 m");
  return size;
}

double farthest(const std::vector<Vector3d>& points) {
  double most = 0.0;
  for (const Vector3d& point : points) most = std::max(most, point.norm());
  return most;
}

/// Ends of a segment along z.
std::vector<Vector3d> ends(double halfLength, const Isometry3d& frame) {
  return {frame * Vector3d(0, 0, -halfLength), frame * Vector3d(0, 0, halfLength)};
}

void addBox(const Json& json, const Isometry3d& frame, const std::string& where,
            ShapeParts& parts) {
  const Vector3d half = readVector(at(json, "half_extents", where), where + ", half_extents");
  Element element;
  for (int corner = 0; corner < 8; ++corner)
    element.points.push_back(frame * Vector3d((corner & 1) != 0 ? half.x() : -half.x(),
                                              (corner & 2) != 0 ? half.y() : -half.y(),
                                              (corner & 4) != 0 ? half.z() : -half.z()));
  element.size = sizeIn(frame, half.norm(), where);
  parts.elements.push_back(std::move(element));
}

void addRound(const Json& json, const std::string& type, const Isometry3d& frame,
              const std::string& where, ShapeParts& parts) {
  const double radius = readSize(json, "radius", where);
  Element element;
  if (type == "sphere") {
    element.points.emplace_back(frame.translation());
    element.radius = radius;
    element.size = sizeIn(frame, radius, where);
  } else {
    const double halfLength = readSize(json, "half_length", where);
    element.size = sizeIn(frame, halfLength + radius, where);
    const std::vector<Vector3d> tips = ends(halfLength, frame);
    const Vector3d axis = frame.linear().col(2);
    if (type == "capsule") {
      element.points = tips;
      element.radius = radius;
    } else if (type == "cylinder") {
      for (const Vector3d& tip : tips) element.discs.push_back({tip, axis, radius});
    } else {  // a cone: the apex at the upper end
      element.discs.push_back({tips[0], axis, radius});
      element.points.push_back(tips[1]);
    }
  }
  parts.elements.push_back(std::move(element));
}

void addEllipsoid(const Json& json, const Isometry3d& frame, const std::string& where,
                  ShapeParts& parts) {
  const Vector3d axes = readVector(at(json, "semi_axes", where), where + ", semi_axes");
  Element element;
  element.ellipsoid = {frame.translation(), frame.linear() * axes.asDiagonal()};
  element.size = sizeIn(frame, axes.norm(), where);
  parts.elements.push_back(std::move(element));
}

void addConvex(const Json& json, const Isometry3d& frame, const std::string& where,
               ShapeParts& parts) {
  Element element;
  const std::vector<Vector3d> points =
      readPoints(at(json, "vertices", where), where + ", vertices");
  if (points.empty()) throw Refusal(where + ": it has no vertices");
  element.radius = readSize(json, "error", where);
  element.size = sizeIn(frame, farthest(points) + element.radius, where);
  for (const Vector3d& point : points) element.points.push_back(frame * point);
  parts.elements.push_back(std::move(element));
}

void addFlat(const Json& json, bool solid, const Isometry3d& frame, const std::string& where,
             ShapeParts& parts) {
  const Vector3d normal = frame.linear() * readUnit(json, "normal", where);
  const double offset = readNumber(at(json, "offset", where), where + ", offset");
  const double size = sizeIn(frame, std::abs(offset), where);
  parts.flats.push_back({normal, offset + normal.dot(frame.translation()), solid, size});
}

/// What is inside is told by the edges that triangles share. By a vertex that is there twice, or a
/// triangle with a corner twice, a closed surface would seem to be open.
void requireWelded(const Surface& surface, const std::string& where) {
  std::set<std::array<double, 3>> places;
  for (const Vector3d& vertex : surface.vertices)
    if (!places.insert({vertex.x(), vertex.y(), vertex.z()}).second)
      throw Refusal(where + ": two vertices of a solid mesh are at the same place");
  for (const auto& [a, b, c] : surface.triangles)
    if (a == b || b == c || c == a)
      throw Refusal(where + ": a triangle of a solid mesh has a corner twice");
}

void addMesh(const Json& json, const Isometry3d& frame, const std::string& where,
             ShapeParts& parts) {
  Surface surface;
  const std::vector<Vector3d> points =
      readPoints(at(json, "vertices", where), where + ", vertices");
  const double size = sizeIn(frame, farthest(points), where);
  for (const Vector3d& point : points) surface.vertices.push_back(frame * point);
  const Json& text = at(json, "triangles", where);
  if (!text.is_string()) throw Refusal(where + ", triangles is not a base64 text");
  const std::vector<std::uint32_t> corners = integersOf(text.get<std::string>(), where);
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    std::array<int, 3> triangle{};
    Element element{.size = size};
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners[i + k] >= surface.vertices.size())
        throw Refusal(where + ": triangle " + std::to_string(i / 3) +
                      " has a corner that is not there");
      triangle[k] = static_cast<int>(corners[i + k]);
      element.points.push_back(surface.vertices[corners[i + k]]);
    }
    surface.triangles.push_back(triangle);
    parts.elements.push_back(std::move(element));
  }
  if (corners.size() % 3 != 0) throw Refusal(where + ": triangles of less than three corners");
  if (surface.triangles.empty()) throw Refusal(where + ": a mesh without triangles");
  const Json& solid = at(json, "solid", where);
  if (!solid.is_boolean()) throw Refusal(where + ": solid is neither true nor false");
  if (!solid.get<bool>()) return;
  requireWelded(surface, where);
  parts.solids.push_back(std::move(surface));
}

void addCloud(const Json& json, const Isometry3d& frame, const std::string& where,
              ShapeParts& parts) {
  const std::vector<Vector3d> points = readPoints(at(json, "points", where), where + ", points");
  const Json& radii = at(json, "radii", where);
  const bool same = radii.is_number();
  std::vector<double> each;
  if (!same) {
    if (!radii.is_string()) throw Refusal(where + ", radii is neither a number nor a base64 text");
    each = doublesOf(radii.get<std::string>(), where + ", radii");
    if (each.size() != points.size()) throw Refusal(where + ": not one radius for each point");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double radius = same ? radii.get<double>() : each[i];
    if (!(radius >= 0.0)) throw Refusal(where + ": a radius is negative");
    parts.elements.push_back({.points = {frame * points[i]},
                              .radius = radius,
                              .size = sizeIn(frame, points[i].norm() + radius, where)});
  }
}

}  // namespace

void readShape(const Json& json, const Isometry3d& frame, const std::string& where,
               ShapeParts& parts) {
  const Json& named = at(json, "type", where);
  const std::string type = named.is_string() ? named.get<std::string>() : "";
  if (type == "box") return addBox(json, frame, where, parts);
  if (type == "sphere" || type == "capsule" || type == "cylinder" || type == "cone")
    return addRound(json, type, frame, where, parts);
  if (type == "ellipsoid") return addEllipsoid(json, frame, where, parts);
  if (type == "convex") return addConvex(json, frame, where, parts);
  if (type == "plane" || type == "half_space")
    return addFlat(json, type == "half_space", frame, where, parts);
  if (type == "mesh") return addMesh(json, frame, where, parts);
  if (type == "cloud") return addCloud(json, frame, where, parts);
  throw Refusal(where + ": no shape '" + type + "'");
}

}  // namespace swept::verify
