// SPDX-License-Identifier: BSD-3-Clause
#include "random_pieces.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

std::string text(double value) {
  std::array<char, 40> digits{};
  std::snprintf(digits.data(), digits.size(), "%.17g", value);
  return digits.data();
}

constexpr std::array<std::array<int, 3>, 4> kFaces{{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};

void writeStl(const std::filesystem::path& file, const std::vector<Vector3d>& corners) {
  std::ofstream out(file);
  out << "solid s\n";
  for (const auto& face : kFaces) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const int i : face) {
      const Vector3d& corner = corners[static_cast<std::size_t>(i)];
      out << "vertex " << urdfText(corner) << "\n";
    }
    out << "endloop\nendfacet\n";
  }
  out << "endsolid s\n";
}

swept::Shape meshOf(const std::vector<Vector3d>& corners) {
  std::vector<Eigen::Vector3i> triangles;
  for (const auto& face : kFaces) triangles.emplace_back(face[0], face[1], face[2]);
  return swept::TriangleMesh::build(corners, triangles);
}

}  // namespace

std::string urdfText(const Vector3d& v) {
  return text(v.x()) + " " + text(v.y()) + " " + text(v.z());
}

std::string urdfOrigin(const Vector3d& place, const Vector3d& rpy) {
  return "<origin xyz=\"" + urdfText(place) + "\" rpy=\"" + urdfText(rpy) + "\"/>";
}

Eigen::Matrix3d turnOf(const Vector3d& rpy) {
  return (Eigen::AngleAxisd(rpy.z(), Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy.y(), Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy.x(), Vector3d::UnitX()))
      .toRotationMatrix();
}

Isometry3d RandomPieces::turned(const Vector3d& place) {
  Isometry3d pose = Isometry3d::Identity();
  const double angle = random_.uniform(0.0, 3.0);
  pose.linear() = Eigen::AngleAxisd(angle, random_.direction()).toRotationMatrix();
  pose.translation() = place;
  return pose;
}

Vector3d RandomPieces::away(double least, double most) {
  const double distance = random_.uniform(least, most);
  return distance * random_.direction();
}

/// Of a tetrahedron around the origin; single precision has them.
std::vector<Vector3d> RandomPieces::corners() {
  std::vector<Vector3d> found{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  for (Vector3d& corner : found)
    for (double& value : corner) value = std::round(1024.0 * value * (0.5 + length())) / 8192.0;
  return found;
}

RandomPiece RandomPieces::mesh() {
  const std::vector<Vector3d> points = corners();
  const std::string name = "mesh" + std::to_string(files_++) + ".stl";
  writeStl(folder_ / name, points);
  return {.shape = meshOf(points), .urdf = "<mesh filename=\"" + name + "\"/>"};
}

RandomPiece RandomPieces::ofLink() {
  const double a = length();
  const double b = length();
  const Vector3d size = random_.inCube().cwiseAbs() * 0.15 + Vector3d::Constant(0.01);
  const std::string rod = "radius=\"" + text(0.3 * a) + "\" length=\"" + text(b) + "\"/>";
  switch (random_.below(5)) {
    case 0:
      return {.shape = swept::makeSphere(a), .urdf = "<sphere radius=\"" + text(a) + "\"/>"};
    case 1:
      return {.shape = swept::makeBox(size), .urdf = "<box size=\"" + urdfText(size) + "\"/>"};
    case 2:
      return {.shape = swept::makeCylinder(0.3 * a, b), .urdf = "<cylinder " + rod};
    case 3:
      return {.shape = swept::makeCapsule(0.3 * a, b), .urdf = "<capsule " + rod};
    default:
      return mesh();
  }
}

RandomPiece RandomPieces::bounded() {
  switch (random_.below(7)) {
    case 0:
      return {.shape = swept::ConvexHull::of(corners())};
    case 1: {
      const double radius = length();
      return {.shape = swept::makeCone(radius, length())};
    }
    default:
      return ofLink();
  }
}

RandomPiece RandomPieces::ofWorld() {
  if (!random_.chance(0.1)) return bounded();
  const double radius = 0.2 * length();
  return {.shape = swept::PointCloud::build(corners(), radius)};
}
