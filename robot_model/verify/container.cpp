// SPDX-License-Identifier: BSD-3-Clause
#include "container.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace swept::verify {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kLeastProduct = 1e-290;  // m^3; products underflow below

double numberAt(const Json& list, std::size_t i, std::size_t count, const std::string& where) {
  if (!list.is_array() || list.size() != count)
    throw Refusal(where + ": not " + std::to_string(count) + " numbers");
  return readNumber(list[i], where);
}

Isometry3d poseOfShape(const Json& list, const std::string& where) {
  std::array<double, 7> n{};
  for (std::size_t i = 0; i < 7; ++i) n[i] = numberAt(list, i, 7, where);
  const Eigen::Quaterniond turn(n[6], n[3], n[4], n[5]);
  if (!(std::abs(turn.norm() - 1.0) < 1e-2)) throw Refusal(where + ": no rotation");
  Isometry3d pose(turn.normalized());
  pose.translation() = Vector3d(n[0], n[1], n[2]);
  return pose;
}

/// Triangles of which each edge is passed as often one way as the other, between points of the
/// hull. So they enclose every point that is behind all of them, and the hull contains what they
/// enclose: how the triangles were found is of no account.
void readHull(const Json& json, const std::string& where, Container& container) {
  std::vector<Vector3d> vertices;
  for (const Json& vertex : readList(json, "vertices", where)) {
    vertices.push_back(readVector(vertex, where + ", vertices"));
    container.reach = std::max(container.reach, vertices.back().lpNorm<1>());
  }
  if (!json.contains("faces")) throw Refusal(where + ": a hull without faces");
  std::map<std::pair<std::size_t, std::size_t>, int> passes;
  for (const Json& triangle : readList(json, "faces", where)) {
    std::array<std::size_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double index = numberAt(triangle, k, 3, where + ", faces");
      if (!(index >= 0.0 && index < static_cast<double>(vertices.size())) ||
          index != std::floor(index))
        throw Refusal(where + ": a face has a corner that is not there");
      corners[k] = static_cast<std::size_t>(index);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t from = corners[k];
      const std::size_t to = corners[(k + 1) % 3];
      passes[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
    }
    const Vector3d& a = vertices[corners[0]];
    const Vector3d along = vertices[corners[1]] - a;
    const Vector3d across = vertices[corners[2]] - a;
    container.faces.push_back({a, along.cross(across), along.norm() * across.norm()});
  }
  if (container.faces.empty()) throw Refusal(where + ": a hull without faces");
  for (const auto& [edge, excess] : passes)
    if (excess != 0) throw Refusal(where + ": the faces of a hull leave an opening");
}

Container containerOf(const Json& json, const std::string& where) {
  Container container;
  const Json& named = at(json, "type", where);
  const std::string type = named.is_string() ? named.get<std::string>() : "";
  if (type == "sphere") {
    container.radius = sizeOf(json, "radius", where);
  } else if (type == "capsule") {
    container.radius = sizeOf(json, "radius", where);
    container.half.z() = 0.5 * sizeOf(json, "length", where);
  } else if (type == "cylinder") {
    container.round = true;
    container.half =
        Vector3d(sizeOf(json, "radius", where), 0.0, 0.5 * sizeOf(json, "length", where));
  } else if (type == "box") {
    container.half = 0.5 * readVector(at(json, "size", where), where + ", size");
    if (!(container.half.minCoeff() >= 0.0)) throw Refusal(where + ": size is negative");
  } else if (type == "convex") {
    readHull(json, where, container);
  } else {
    throw Refusal(where + ": nothing is shown of the type '" + type + "'");
  }
  container.shape_from_link = poseOfShape(at(json, "pose", where), where + ", pose").inverse();
  return container;
}

}  // namespace

bool Container::contains(const Vector3d& point, double around) const {
  const Vector3d at = shape_from_link * point;
  if (!faces.empty())
    return std::ranges::all_of(faces, [&](const Face& face) {
      return face.normal.dot(face.corner - at) > face.size * around + kLeastProduct;
    });
  if (round)
    return std::hypot(at.x(), at.y()) + around <= half.x() && std::abs(at.z()) + around <= half.z();
  if (radius == 0.0) return ((at.cwiseAbs().array() + around) <= half.array()).all();
  const Vector3d beyond = (at.cwiseAbs() - half).cwiseMax(0.0);
  return beyond.norm() + around <= radius;
}

double sizeOf(const Json& json, const char* key, const std::string& where) {
  const double value = readNumber(at(json, key, where), where + ", " + key);
  if (!(value >= 0.0)) throw Refusal(where + ": " + key + " is negative");
  return value;
}

std::vector<Container> containersOf(const Json& link, const std::string& where) {
  std::vector<Container> containers;
  if (link.contains("spheres"))
    for (const Json& sphere : readList(link, "spheres", where)) {
      Container container;
      container.radius = numberAt(sphere, 3, 4, where);
      if (!(container.radius >= 0.0)) throw Refusal(where + ": a radius is negative");
      container.shape_from_link.translation() =
          -Vector3d(numberAt(sphere, 0, 4, where), numberAt(sphere, 1, 4, where),
                    numberAt(sphere, 2, 4, where));
      containers.push_back(container);
    }
  else
    for (const Json& shape : readList(link, "shapes", where))
      containers.push_back(containerOf(shape, where));
  return containers;
}

}  // namespace swept::verify
