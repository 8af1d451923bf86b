// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstring>

#include "exact.hpp"

namespace forgeries {
namespace {

/// Bits of a text in base64.
std::vector<unsigned char> bytesOf(const std::string& text) {
  static const std::string kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  unsigned int bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned int>(kDigits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<unsigned char>(bits >> count & 255u));
  }
  return bytes;
}

template <typename Number>
std::vector<Number> numbersOf(const Json& text) {
  const std::vector<unsigned char> bytes = bytesOf(text.get<std::string>());
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

std::vector<Vec> pointsOf(const Json& text) {
  const std::vector<double> numbers = numbersOf<double>(text);
  std::vector<Vec> points;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    points.push_back({Real(numbers[i]), Real(numbers[i + 1]), Real(numbers[i + 2])});
  return points;
}

void addMesh(const Json& shape, const Pose& frame, ExactBody& body) {
  const std::vector<Vec> vertices = pointsOf(shape["vertices"]);
  const std::vector<std::uint32_t> corners = numbersOf<std::uint32_t>(shape["triangles"]);
  Shell shell;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const std::array<Vec, 3> own{vertices[corners[i]], vertices[corners[i + 1]],
                                 vertices[corners[i + 2]]};
    body.solids.push_back({.frame = frame, .type = "convex", .points = {own[0], own[1], own[2]}});
    shell.push_back({frame * own[0], frame * own[1], frame * own[2]});
  }
  if (shape["solid"].get<bool>()) body.shells.push_back(std::move(shell));
}

void addCloud(const Json& shape, const Pose& frame, ExactBody& body) {
  const std::vector<Vec> points = pointsOf(shape["points"]);
  std::vector<double> radii(points.size());
  if (shape["radii"].is_string())
    radii = numbersOf<double>(shape["radii"]);
  else
    std::ranges::fill(radii, shape["radii"].get<double>());
  for (std::size_t i = 0; i < points.size(); ++i)
    body.solids.push_back(
        {.frame = frame, .type = "convex", .points = {points[i]}, .radius = Real(radii[i])});
}

Real across(const Vec& direction) {
  return root(direction.x * direction.x + direction.y * direction.y);
}

}  // namespace

Real Solid::support(const Vec& direction) const {
  const Vec d = frame.back(direction);
  const Real flat = direction.dot(frame.translation);
  const Real base = radius == 0 ? flat : flat + radius * direction.norm();
  if (type == "box")
    return base + abs(extents.x * d.x) + abs(extents.y * d.y) + abs(extents.z * d.z);
  if (type == "ellipsoid") {
    const Vec stretched{extents.x * d.x, extents.y * d.y, extents.z * d.z};
    return base + stretched.norm();
  }
  if (type == "sphere") return base;
  const Real end = halfLength * d.z;
  if (type == "capsule") return base + abs(end);
  // Discs have their radius across.
  const Real disc = radius * across(d);
  if (type == "cylinder") return flat + abs(end) + disc;
  if (type == "cone") return flat + std::max(end, Real(disc - end));
  Real most = d.dot(points.front());
  for (const Vec& point : points) most = std::max(most, d.dot(point));
  return base + most;
}

ExactBody bodyOf(const Json& json) {
  ExactBody body;
  if (!json["link"].is_null()) body.link = json["link"];
  for (const Json& shape : json["shapes"]) {
    const Pose frame = poseOf(shape["pose"]);
    const std::string type = shape["type"];
    const auto number = [&](const char* key) {
      return shape.contains(key) ? Real(shape[key].get<double>()) : Real(0);
    };
    if (type == "plane" || type == "half_space") {
      const Vec normal = frame.turned(vecOf(shape["normal"]));
      const Real offset = number("offset") + normal.dot(frame.translation);
      body.walls.push_back({normal, offset, type == "half_space"});
    } else if (type == "mesh") {
      addMesh(shape, frame, body);
    } else if (type == "cloud") {
      addCloud(shape, frame, body);
    } else {
      Solid solid{.frame = frame, .type = type};
      solid.radius = type == "convex" ? number("error") : number("radius");
      solid.halfLength = number("half_length");
      if (type == "box") solid.extents = vecOf(shape["half_extents"]);
      if (type == "ellipsoid") solid.extents = vecOf(shape["semi_axes"]);
      if (type == "convex") solid.points = pointsOf(shape["vertices"]);
      body.solids.push_back(std::move(solid));
    }
  }
  return body;
}

}  // namespace forgeries
