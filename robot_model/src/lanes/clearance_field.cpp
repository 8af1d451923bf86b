// SPDX-License-Identifier: BSD-3-Clause
#include "lanes/clearance_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lanes/voxels.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;
using Mask = Voxels::Mask;

/// m. Finer voxels than this are not worth their memory.
constexpr double kFinestVoxel = 0.003;
/// Cells, as far as their values reach.
constexpr int kFarthest = 20;
/// Twice a gap in cells, squared: gaps are whole or half cells, so sums of these are exact.
using Squared = std::int16_t;
constexpr Squared kUnknown = (2 * kFarthest) * (2 * kFarthest);
static_assert(3 * kUnknown <= std::numeric_limits<Squared>::max());
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The gap between the middle of a cell and the `k`-th cell from it, along one axis.
constexpr Squared gapSquared(int k) {
  return k == 0 ? Squared{0} : static_cast<Squared>((2 * k - 1) * (2 * k - 1));
}

void lowerRow(Squared* to, Squared most, int count) {
  for (int i = 0; i < count; ++i) to[i] = std::min(to[i], most);
}
void lowerRow(Squared* __restrict to, const Squared* __restrict from, Squared gap, int count) {
  for (int i = 0; i < count; ++i) to[i] = std::min(to[i], static_cast<Squared>(from[i] + gap));
}

/// Steps that are not above the root of a squared gap, by more than roundings.
class Steps {
 public:
  /// `side`: m, of cells or voxels; `most`: of those, a gap.
  Steps(double side, double most) : units_(kUnknown + 1) {
    step_ = static_cast<float>(side * most / 255.0);
    for (int value = 0; value <= kUnknown; ++value) {
      const double gap = 0.5 * std::sqrt(static_cast<double>(value)) * side * (1.0 - 1e-6);
      const double units = std::floor(gap / static_cast<double>(step_));
      units_[value] = static_cast<std::uint32_t>(std::min(units, 255.0));
    }
  }
  std::uint32_t operator()(Squared value) const { return units_[value]; }
  float step() const { return step_; }

 private:
  std::vector<std::uint32_t> units_;
  float step_;
};

/// Distances of all cells from the marked ones, exact for whole cells: the least over an axis of
/// the least over another (Saito, Toriwaki 1994).
class CellDistances {
 public:
  CellDistances(const Voxels& voxels, const ClearanceField& field) {
    for (int i = 0; i < 3; ++i) {
      count_[i] = 2 * voxels.blocks()[i];
      cutBefore_[i] = std::isinf(field.lower[i]);
      cutAfter_[i] = std::isinf(field.upper[i]);
    }
    squared_.assign(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2], kUnknown);
    std::size_t i = 0;
    for (int z = 0; z < count_[2]; ++z)
      for (int y = 0; y < count_[1]; ++y)
        for (int x = 0; x < count_[0]; ++x, ++i)
          if (voxels.cell(x, y, z)) squared_[i] = 0;
    spreadAlongX();
    spreadAlong(1);
    spreadAlong(2);
  }

  void store(ClearanceField& field) const {
    // What no value says of is at least this far.
    const Steps steps(2.0 * static_cast<double>(field.voxel), kFarthest - 0.5);
    field.step = steps.step();
    field.cells.assign(squared_.size() / 4 + 1, 0);
    for (std::size_t i = 0; i < squared_.size(); ++i)
      field.cells[i / 4] |= steps(squared_[i]) << (8 * (i % 4));
  }

 private:
  std::size_t indexOf(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * count_[1] + y) * count_[0] + x;
  }

  /// Gaps to what is marked, and to where the window cut the shape.
  void spreadAlongX() {
    const int count = count_[0];
    for (std::size_t row = 0; row < squared_.size(); row += count) {
      int gap = cutBefore_[0] ? 0 : kFarthest;
      const auto pass = [&](Squared& value) {
        gap = value == 0 ? 0 : std::min(gap + 1, kFarthest);
        if (gap < kFarthest) value = std::min(value, gapSquared(gap));
      };
      for (int i = 0; i < count; ++i) pass(squared_[row + i]);
      gap = cutAfter_[0] ? 0 : kFarthest;
      for (int i = count; i-- > 0;) pass(squared_[row + i]);
    }
  }

  /// The least of what the cells of each line along an axis have, plus the square of the gap to
  /// them. Lines that are neighbours along x are done together.
  void spreadAlong(int axis) {
    const int nx = count_[0];
    const int count = count_[axis];
    const int others = axis == 1 ? count_[2] : count_[1];
    const std::ptrdiff_t stride = axis == 1 ? nx : std::ptrdiff_t{nx} * count_[1];
    const std::vector<Squared> from = squared_;
    for (int other = 0; other < others; ++other) {
      const std::size_t begin = axis == 1 ? indexOf(0, 0, other) : indexOf(0, other, 0);
      for (int i = 0; i < count; ++i) {
        Squared* const to = &squared_[begin + i * stride];
        const Squared* const source = &from[begin + i * stride];
        const int before = cutBefore_[axis] ? i + 1 : kFarthest;
        const int after = cutAfter_[axis] ? count - i : kFarthest;
        lowerRow(to, gapSquared(std::min({before, after, kFarthest})), nx);
        for (int k = 1; k < kFarthest; ++k) {
          if (i >= k) lowerRow(to, source - k * stride, gapSquared(k), nx);
          if (i + k < count) lowerRow(to, source + k * stride, gapSquared(k), nx);
        }
      }
    }
  }

  std::array<int, 3> count_;
  std::array<bool, 3> cutBefore_;
  std::array<bool, 3> cutAfter_;
  std::vector<Squared> squared_;
};

/// Distances of the voxels of blocks from the marked ones of the blocks around. Beyond these
/// anything may be, so no distance is larger than that to their border.
class BrickDistances {
 public:
  BrickDistances(const Voxels& voxels, ClearanceField& field)
      : voxels_(voxels), field_(field), steps_(static_cast<double>(field.voxel), kMost) {
    field.fineStep = steps_.step();
    for (int row = 0; row < (1 << kWindow); ++row) {
      for (int x = 0; x < 4; ++x) {
        Squared least = kUnknown;
        for (int k = 0; k < kWindow; ++k)
          if ((row >> k & 1) != 0) least = std::min(least, gapSquared(std::abs(k - 4 - x)));
        ofRow_[row][x] = least;
      }
    }
  }

  void store() {
    const auto [nx, ny, nz] = field_.blocks;
    field_.bricks.assign(static_cast<std::size_t>(nx) * ny * nz, 0);
    field_.voxels.assign(16, 0);
    for (int z = 0; z < nz; ++z) {
      for (int y = 0; y < ny; ++y) {
        for (int x = 0; x < nx; ++x) {
          if (voxels_.block(x, y, z) == Voxels::kFull || !look(x, y, z)) continue;
          field_.bricks[voxels_.blockIndex(x, y, z)] =
              static_cast<std::int32_t>(field_.voxels.size() / 16);
          spread();
        }
      }
    }
  }

 private:
  static constexpr int kWindow = 12;  ///< voxels: three blocks
  static constexpr double kMost = 5.5;

  /// The blocks around; false: they are empty.
  bool look(int x, int y, int z) {
    bool any = false;
    for (int i = 0; i < 27; ++i) {
      around_[i] = maskAt(x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1);
      any = any || around_[i] != 0;
    }
    return any;
  }

  Mask maskAt(int x, int y, int z) const {
    const std::array<int, 3> at = {x, y, z};
    for (int i = 0; i < 3; ++i) {
      if (at[i] < 0) return std::isinf(field_.lower[i]) ? Voxels::kFull : 0;
      if (at[i] >= field_.blocks[i]) return std::isinf(field_.upper[i]) ? Voxels::kFull : 0;
    }
    return voxels_.block(x, y, z);
  }

  void spread() {
    std::array<Squared, kWindow * kWindow * 4> rows;
    for (int z = 0; z < kWindow; ++z) {
      for (int y = 0; y < kWindow; ++y) {
        const Mask* blocks = &around_[3 * (y / 4) + 9 * (z / 4)];
        const int shift = 4 * (y % 4) + 16 * (z % 4);
        const auto bits = (blocks[0] >> shift & 15U) | (blocks[1] >> shift & 15U) << 4 |
                          (blocks[2] >> shift & 15U) << 8;
        std::ranges::copy(ofRow_[bits], &rows[4 * (kWindow * z + y)]);
      }
    }
    std::array<Squared, 4 * kWindow * 4> columns;
    columns.fill(kUnknown);
    for (int z = 0; z < 4; ++z)
      for (int from = 0; from < kWindow; ++from)
        lowerRow(&columns[4 * kWindow * z], &rows[4 * kWindow * from],
                 gapSquared(std::abs(from - 4 - z)), 4 * kWindow);
    for (int z = 0; z < 4; ++z) {
      for (int y = 0; y < 4; ++y) {
        std::array<Squared, 4> least;
        for (int x = 0; x < 4; ++x) least[x] = toBorder(x, y, z);
        for (int from = 0; from < kWindow; ++from)
          lowerRow(least.data(), &columns[4 * (kWindow * z + from)],
                   gapSquared(std::abs(from - 4 - y)), 4);
        std::uint32_t word = 0;
        for (int x = 0; x < 4; ++x) word |= steps_(least[x]) << (8 * x);
        field_.voxels.push_back(word);
      }
    }
  }

  /// Of the window, from the middle of a voxel.
  static Squared toBorder(int x, int y, int z) {
    const auto along = [](int i) { return 2 * std::min(4 + i, 7 - i) + 1; };
    const int least = std::min({along(x), along(y), along(z)});
    return static_cast<Squared>(least * least);
  }

  const Voxels& voxels_;
  ClearanceField& field_;
  Steps steps_;
  std::array<std::array<Squared, 4>, 1 << kWindow> ofRow_;
  std::array<Mask, 27> around_{};
};

/// m, side of voxels such that not too many are to be marked.
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
  return 2.0 * cloud.radius() / std::max(across - 1.0, 1.0);
}

/// m; at least `side`, and such that there are not many more cells.
double voxelSide(const Vector3d& size, double least, std::size_t cells) {
  constexpr double kFewest = 1000.0;  // whatever the side, some are beyond the shape
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
  const double side = voxelSide(upper - lower, least, cells);
  field.voxel = static_cast<float>(side);
  field.origin = lower - Vector3d::Constant(2.0 * side);
  for (int i = 0; i < 3; ++i) {
    // A layer of cells beyond the shape's own box: W, or nothing where the window cut it.
    field.blocks[i] = static_cast<int>(std::ceil((upper[i] - lower[i]) / (4.0 * side))) + 1;
    field.lower[i] = box.lower[i] < lower[i] ? -kInfinity : 0.0;
    field.upper[i] = box.upper[i] > upper[i] ? kInfinity : 4.0 * side * field.blocks[i];
  }
  const double reach = std::max(box.lower.lpNorm<1>(), box.upper.lpNorm<1>());
  return {field.origin, side, field.blocks, reach};
}

std::shared_ptr<const ClearanceField> measured(const Voxels& voxels, ClearanceField& field) {
  CellDistances(voxels, field).store(field);
  BrickDistances(voxels, field).store();
  return std::make_shared<const ClearanceField>(std::move(field));
}

}  // namespace

std::shared_ptr<const ClearanceField> buildClearanceField(const Shape& shape, const Aabb& window,
                                                          std::size_t cells) {
  ClearanceField field;
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) {
    const Aabb box = Aabb::fit(mesh->vertices());
    if (!box.overlaps(window)) return nullptr;
    Voxels voxels = layOut(box, window, sideFor(*mesh, window), cells, field);
    const auto& vertices = mesh->vertices();
    for (const TriangleMesh::Triangle& triangle : mesh->triangles())
      voxels.mark({vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]});
    if (mesh->interior() == MeshInterior::Solid && mesh->report().closedComponents > 0)
      voxels.fill(*mesh);
    return measured(voxels, field);
  }
  if (const auto* cloud = std::get_if<PointCloud>(&shape)) {
    const Aabb box = Aabb::fit(cloud->points()).inflated(cloud->radius());
    if (!box.overlaps(window)) return nullptr;
    Voxels voxels = layOut(box, window, sideFor(*cloud), cells, field);
    for (const Vector3d& point : cloud->points()) voxels.mark(point, cloud->radius());
    return measured(voxels, field);
  }
  return nullptr;
}

}  // namespace swept::detail
