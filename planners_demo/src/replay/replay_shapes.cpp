// SPDX-License-Identifier: BSD-3-Clause
#include "replay/replay_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <vector>

#include "replay/flat_terrain.hpp"
#include "swept/core/height_field.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> readPoints(const JsonValue& place) {
  std::vector<Vector3d> points;
  for (const JsonValue& item : place.elements()) points.push_back(item.vector3());
  if (points.empty()) place.fail("must hold at least one point");
  return points;
}

Vector3d readSizes(const JsonValue& place) {
  Vector3d sizes;
  int axis = 0;
  for (const JsonValue& item : place.elements(3)) sizes[axis++] = item.notNegative();
  return sizes;
}

double positive(const JsonValue& place) {
  const double given = place.number();
  if (!(given > 0.0)) place.refuse("greater than 0");
  return given;
}

Shape readCylinder(const JsonValue& shape) {
  const double radius = shape.at("radius").notNegative();
  return makeCylinder(radius, shape.at("length").notNegative());
}

Shape readCapsule(const JsonValue& shape) {
  const double radius = shape.at("radius").notNegative();
  return makeCapsule(radius, shape.at("length").notNegative());
}

Shape readCone(const JsonValue& shape) {
  const double radius = shape.at("radius").notNegative();
  return makeCone(radius, shape.at("length").notNegative());
}

Shape readTriangle(const JsonValue& shape) {
  shape.at("vertices").elements(3);
  const std::vector<Vector3d> corners = readPoints(shape.at("vertices"));
  return makeTriangle(corners[0], corners[1], corners[2]);
}

Shape readPlane(const JsonValue& shape) {
  const Vector3d normal = shape.at("normal").vector3();
  return makePlane(normal, shape.at("offset").number());
}

Shape readHalfSpace(const JsonValue& shape) {
  const Vector3d normal = shape.at("normal").vector3();
  return makeHalfSpace(normal, shape.at("offset").number());
}

/// Cubes of a grid, as one mesh. Faces between two of them are left out.
class Cubes {
 public:
  using Cell = std::array<long long, 3>;

  Cubes(const std::set<Cell>& cells, const Vector3d& lower, const Vector3d& size)
      : cells_(cells), lower_(lower), size_(size) {
    for (const Cell& cell : cells_) {
      for (int axis = 0; axis < 3; ++axis)
        for (const int side : {0, 1}) addFace(cell, axis, side);
    }
  }
  TriangleMesh mesh() const { return TriangleMesh::build(vertices_, triangles_); }

 private:
  static std::size_t index(int axis) { return static_cast<std::size_t>(axis % 3); }

  /// Towards larger coordinates for side 1.
  void addFace(const Cell& cell, int axis, int side) {
    Cell neighbour = cell;
    neighbour[index(axis)] += side == 1 ? 1 : -1;
    if (cells_.contains(neighbour)) return;
    Cell corner = cell;
    corner[index(axis)] += side;
    Cell alongU = corner, across = corner, alongV = corner;
    ++alongU[index(axis + 1)];
    ++alongV[index(axis + 2)];
    ++across[index(axis + 1)];
    ++across[index(axis + 2)];
    const int a = vertex(corner), b = vertex(alongU), c = vertex(across), d = vertex(alongV);
    if (side == 1)
      triangles_.insert(triangles_.end(), {{a, b, c}, {a, c, d}});
    else
      triangles_.insert(triangles_.end(), {{a, c, b}, {a, d, c}});
  }

  int vertex(const Cell& node) {
    const auto [place, isNew] = indices_.try_emplace(node, static_cast<int>(vertices_.size()));
    if (isNew) {
      const Vector3d steps(static_cast<double>(node[0]), static_cast<double>(node[1]),
                           static_cast<double>(node[2]));
      vertices_.push_back(lower_ + steps.cwiseProduct(size_));
    }
    return place->second;
  }

  const std::set<Cell>& cells_;
  Vector3d lower_, size_;
  std::map<Cell, int> indices_;
  std::vector<Vector3d> vertices_;
  std::vector<TriangleMesh::Triangle> triangles_;
};

Shape readMeshBox(const JsonValue& shape) {
  const Vector3d size = readSizes(shape.at("size"));
  if (!(size.minCoeff() > 0.0)) shape.at("size").refuse("greater than 0");
  return Cubes({{0, 0, 0}}, -0.5 * size, size).mesh();
}

Shape readOctree(const JsonValue& shape) {
  const double resolution = positive(shape.at("resolution"));
  const JsonValue place = shape.at("occupied_points");
  std::set<Cubes::Cell> cells;
  for (const Vector3d& point : readPoints(place)) {
    const Vector3d cell = (point / resolution).array().floor();
    constexpr double kLargest = 1e15;  // neighbours of a cell are other numbers up to there
    if (!(cell.cwiseAbs().maxCoeff() < kLargest))
      place.fail("holds a point more than 1e15 cells from the origin");
    cells.insert({static_cast<long long>(cell.x()), static_cast<long long>(cell.y()),
                  static_cast<long long>(cell.z())});
  }
  return Cubes(cells, Vector3d::Zero(), Vector3d::Constant(resolution)).mesh();
}

Terrain readTerrain(const JsonValue& shape) {
  const JsonValue place = shape.at("heights");
  if (place.isText()) return readFlatTerrain(place);
  const auto rows = place.elements();
  if (rows.empty()) place.fail("must hold at least two rows");
  const std::size_t columns = rows.front().elements().size();
  Terrain terrain{
      Eigen::MatrixXd(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns)),
      shape.at("base").number()};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto row = rows[r].elements(columns);
    for (std::size_t c = 0; c < columns; ++c)
      terrain.heights(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = row[c].number();
  }
  return terrain;
}

Shape readHeightField(const JsonValue& shape) {
  const double xSize = positive(shape.at("x_dim")), ySize = positive(shape.at("y_dim"));
  const Terrain terrain = readTerrain(shape);
  return heightField(xSize, ySize, terrain.heights, terrain.base);
}

using ShapeReader = Shape (*)(const JsonValue&);
const std::map<std::string, ShapeReader> kShapes = {
    {"box", [](const JsonValue& s) -> Shape { return makeBox(readSizes(s.at("size"))); }},
    {"sphere",
     [](const JsonValue& s) -> Shape { return makeSphere(s.at("radius").notNegative()); }},
    {"cylinder", readCylinder},
    {"capsule", readCapsule},
    {"cone", readCone},
    {"ellipsoid",
     [](const JsonValue& s) -> Shape { return makeEllipsoid(readSizes(s.at("radii"))); }},
    {"convex",
     [](const JsonValue& s) -> Shape { return ConvexHull::of(readPoints(s.at("vertices"))); }},
    {"triangle", readTriangle},
    {"plane", readPlane},
    {"halfspace", readHalfSpace},
    {"mesh_box", readMeshBox},
    {"heightfield", readHeightField},
    {"octree", readOctree},
};

}  // namespace

bool isReplayShape(const std::string& type) {
  return kShapes.contains(type);
}

Shape readReplayShape(const JsonValue& shape) {
  try {
    return kShapes.at(shape.at("type").text())(shape);
  } catch (const std::invalid_argument& error) {
    shape.fail(std::string("is no shape: ") + error.what());
  }
}

}  // namespace swept
