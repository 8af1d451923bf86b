// SPDX-License-Identifier: BSD-3-Clause
#include "clearance_grid/build_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clearance_grid/field_distances.hpp"
#include "threads/crew.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// m. Finer voxels than this are not worth their memory.
constexpr double kFinestVoxel = 0.003;
/// Four times the allowance of Voxels for rounding, relative to the coordinates.
constexpr double kVoxelRoundings = 8e-12;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// m, side of voxels such that not too many must be marked.
double sideFor(const TriangleMesh& mesh, const Aabb& window) {
  constexpr double kMostMarks = 8e6;
  double area = 0.0;
  double length = 0.0;
  for (const TriangleMesh::Triangle& triangle : mesh.triangles()) {
    const Vector3d& a = mesh.vertices()[triangle[0]];
    const Vector3d& b = mesh.vertices()[triangle[1]];
    const Vector3d& c = mesh.vertices()[triangle[2]];
    const Vector3d lower = a.cwiseMin(b).cwiseMin(c).cwiseMax(window.lower);
    const Vector3d upper = a.cwiseMax(b).cwiseMax(c).cwiseMin(window.upper);
    if ((lower.array() > upper.array()).any()) continue;
    const double across = (upper - lower).norm();
    area += std::min(0.5 * (b - a).cross(c - a).norm(), 0.8 * across * across);
    length += across;
  }
  return std::max(std::sqrt(area / kMostMarks), length / kMostMarks);
}
double sideFor(const PointCloud& cloud) {
  constexpr double kMostMarks = 3e7;
  const double across = std::cbrt(kMostMarks / static_cast<double>(cloud.points().size()));
  return 2.0 * cloud.largestRadius() / std::max(across - 1.0, 1.0);
}

/// m; at least `side`, and such that there are not many more cells.
double voxelSide(const Vector3d& size, double least, std::size_t cells) {
  constexpr double kFewest = 1000.0;  // whatever the side, some cells are beyond the shape
  double side = std::max(kFinestVoxel, least);
  const auto along = [&](int i) { return std::ceil(size[i] / (2.0 * side)) + 4.0; };
  const double most = std::max(static_cast<double>(cells), kFewest);
  while (along(0) * along(1) * along(2) > most) side *= 1.05;
  return static_cast<double>(static_cast<float>(side));
}

/// Empty, and Voxels for it.
Voxels layOut(const Aabb& box, const Aabb& window, double least, std::size_t cells,
              ClearanceField& field) {
  const Vector3d lower = box.lower.cwiseMax(window.lower);
  const Vector3d upper = box.upper.cwiseMin(window.upper);
  const double reach = std::max(box.lower.lpNorm<1>(), box.upper.lpNorm<1>());
  // Far out, rounding would cover several voxels of the finest kind.
  const double side = voxelSide(upper - lower, std::max(least, kVoxelRoundings * reach), cells);
  field.voxel = static_cast<float>(side);
  field.origin = lower - Vector3d::Constant(2.0 * side);
  for (int i = 0; i < 3; ++i) {
    // A layer of cells beyond the shape's own box (W), or none where the window cut it.
    field.blocks[i] = static_cast<int>(std::ceil((upper[i] - lower[i]) / (4.0 * side))) + 1;
    field.lower[i] = box.lower[i] < lower[i] ? -kInfinity : 0.0;
    field.upper[i] = box.upper[i] > upper[i] ? kInfinity : 4.0 * side * field.blocks[i];
  }
  return {field.origin, side, field.blocks, reach};
}

/// Enough cells to be worth a thread of their own: half a millisecond of work.
constexpr std::size_t kCellsOfThread = std::size_t{1} << 16;

std::size_t cellsOf(const ClearanceField& field) {
  const auto [nx, ny, nz] = field.blocks;
  return std::size_t{8} * nx * ny * nz;
}

std::shared_ptr<const ClearanceField> measured(const Voxels& voxels, Crew& crew,
                                               ClearanceField& field) {
  measureCells(voxels, crew, field);
  measureBricks(voxels, crew, field);
  return std::make_shared<const ClearanceField>(std::move(field));
}

}  // namespace

Aabb fieldBox(const TriangleMesh& mesh) {
  return Aabb::fit(mesh.vertices());
}
Aabb fieldBox(const PointCloud& cloud) {
  return Aabb::fit(cloud.points()).inflated(cloud.largestRadius());
}

std::shared_ptr<const ClearanceField> buildField(const TriangleMesh& mesh, const Aabb& window,
                                                 std::size_t cells) {
  ClearanceField field;
  Voxels voxels = layOut(fieldBox(mesh), window, sideFor(mesh, window), cells, field);
  const auto& vertices = mesh.vertices();
  for (const TriangleMesh::Triangle& triangle : mesh.triangles())
    voxels.mark({vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]});
  if (mesh.interior() == MeshInterior::Solid && mesh.report().closedComponents > 0)
    voxels.fill(mesh);
  Crew crew(threadsFor(cellsOf(field), kCellsOfThread));
  return measured(voxels, crew, field);
}

std::shared_ptr<const ClearanceField> buildField(const PointCloud& cloud, const Aabb& window,
                                                 std::size_t cells) {
  ClearanceField field;
  Voxels voxels = layOut(fieldBox(cloud), window, sideFor(cloud), cells, field);
  Crew crew(threadsFor(cellsOf(field), kCellsOfThread));
  voxels.mark(cloud, crew);
  return measured(voxels, crew, field);
}

}  // namespace swept::detail
