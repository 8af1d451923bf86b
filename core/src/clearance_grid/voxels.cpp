// SPDX-License-Identifier: BSD-3-Clause
#include "clearance_grid/voxels.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>

#include "threads/crew.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;
using Mask = Voxels::Mask;

// Voxels on the faces of a block.
constexpr Mask kFirstX = 0x1111111111111111;
constexpr Mask kLastX = kFirstX << 3;
constexpr Mask kFirstY = 0x000F000F000F000F;
constexpr Mask kLastY = kFirstY << 12;

/// States of cells in the flood fills: marked, on one side of the surface or the other, or not yet
/// seen.
constexpr std::uint8_t kUnseen = 0, kMarked = 1, kOutside = 2, kInside = 3;

/// With the neighbours within the block.
Mask grown(Mask mask) {
  return mask | (mask & ~kLastX) << 1 | (mask & ~kFirstX) >> 1 | (mask & ~kLastY) << 4 |
         (mask & ~kFirstY) >> 4 | mask << 16 | mask >> 16;
}

}  // namespace

/// The cells of a grid, x first, with a layer of other cells around them, so that every cell has
/// all its neighbours.
class CellGrid {
 public:
  explicit CellGrid(const std::array<int, 3>& blocks) {
    for (int i = 0; i < 3; ++i) {
      blocks_[i] = static_cast<std::size_t>(blocks[i]);
      count_[i] = 2 * blocks_[i] + 2;
    }
    steps_ = {1, count_[0], count_[0] * count_[1]};
  }

  std::size_t size() const { return steps_[2] * count_[2]; }
  const std::array<std::size_t, 3>& steps() const { return steps_; }

  /// Bits 0, 1, 2 of `which`: the cell's place in the block along x, y, z.
  std::size_t cellOf(std::size_t block, int which) const {
    const std::size_t x = 2 * (block % blocks_[0]) + 1 + (which & 1);
    const std::size_t y = 2 * (block / blocks_[0] % blocks_[1]) + 1 + (which >> 1 & 1);
    const std::size_t z = 2 * (block / (blocks_[0] * blocks_[1])) + 1 + (which >> 2);
    return x + y * steps_[1] + z * steps_[2];
  }

  /// In cells.
  Vector3d middleOf(std::size_t cell) const {
    const std::size_t x = cell % count_[0];
    const std::size_t y = cell / count_[0] % count_[1];
    const std::size_t z = cell / steps_[2];
    return Vector3d(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)) -
           Vector3d::Constant(0.5);
  }

  void markBorder(std::vector<std::uint8_t>& cells) const {
    for (std::size_t z = 0; z < count_[2]; ++z) {
      for (std::size_t y = 0; y < count_[1]; ++y) {
        const std::size_t row = y * steps_[1] + z * steps_[2];
        const bool whole = z == 0 || z + 1 == count_[2] || y == 0 || y + 1 == count_[1];
        std::fill_n(&cells[row], whole ? count_[0] : 1, kMarked);
        cells[row + count_[0] - 1] = kMarked;
      }
    }
  }

 private:
  std::array<std::size_t, 3> blocks_;
  std::array<std::size_t, 3> count_;
  std::array<std::size_t, 3> steps_;
};

Voxels::Voxels(const Vector3d& origin, double side, const std::array<int, 3>& blocks, double reach)
    : origin_(origin),
      side_(side),
      inverse_(1.0 / side),
      // More than all rounding of points computed between corners, and of encloses().
      slack_(1e-12 * (reach + origin.lpNorm<1>()) + 1e-9 * side),
      blocks_(blocks) {
  masks_.assign(static_cast<std::size_t>(blocks[0]) * blocks[1] * blocks[2], 0);
}

/// The voxels that a box meets; false: none.
bool Voxels::voxelsOf(const Vector3d& lower, const Vector3d& upper, Eigen::Array3i& first,
                      Eigen::Array3i& last) const {
  for (int i = 0; i < 3; ++i) {
    const double from = (lower[i] - slack_ - origin_[i]) * inverse_;
    const double to = (upper[i] + slack_ - origin_[i]) * inverse_;
    const int count = 4 * blocks_[i];
    if (!(to >= 0.0) || !(from < count)) return false;
    first[i] = static_cast<int>(std::max(from, 0.0));
    last[i] = static_cast<int>(std::min(to, count - 1.0));
  }
  return true;
}

void Voxels::set(int x, int y, int z) {
  const std::size_t block = blockIndex(x / 4, y / 4, z / 4);
  if (masks_[block] == 0) surface_.push_back(block);
  masks_[block] |= Mask{1} << (x % 4 + 4 * (y % 4) + 16 * (z % 4));
}

/// Lemma: a voxel that meets the triangle is neither wholly on one side of its plane nor wholly
/// outside one of its sides. If the normal is zero, all voxels are marked.
void Voxels::markVoxels(const Eigen::Array3i& first, const Eigen::Array3i& last,
                        const Vector3d& normal, const std::array<Vector3d, 3>& corners) {
  const double half = 0.5 * side_ + slack_;
  const double thickness = half * normal.lpNorm<1>();
  Vector3d inward[3];
  double beyond[3];
  for (int i = 0; i < 3; ++i) {
    inward[i] = normal.cross(corners[(i + 1) % 3] - corners[i]);
    // Of the voxel's middle, from the corner.
    beyond[i] = inward[i].dot(corners[i]) - half * inward[i].lpNorm<1>();
  }
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) {
        const Vector3d at = middle(x, y, z);
        if (std::abs(normal.dot(at - corners[0])) > thickness) continue;
        if (inward[0].dot(at) < beyond[0] || inward[1].dot(at) < beyond[1] ||
            inward[2].dot(at) < beyond[2])
          continue;
        set(x, y, z);
      }
    }
  }
}

/// Marks balls, several threads at a time: a set of bits is the same in whatever order it is made.
class Voxels::BallMarker {
 public:
  explicit BallMarker(Voxels& voxels)
      : voxels_(voxels), half_(0.5 * voxels.side_ + voxels.slack_) {}

  void mark(const Vector3d& center, double radius) {
    Eigen::Array3i first;
    Eigen::Array3i last;
    const Vector3d reach = Vector3d::Constant(radius);
    if (!voxels_.voxelsOf(center - reach, center + reach, first, last)) return;
    most_ = (radius + voxels_.slack_) * (radius + voxels_.slack_);
    for (int i = 0; i < 3; ++i) {
      first_[i] = first[i];
      last_[i] = last[i];
      findGaps(center[i], i);
    }
    for (int z = first_[2] >> 2; z <= last_[2] >> 2; ++z)
      for (int y = first_[1] >> 2; y <= last_[1] >> 2; ++y)
        for (int x = first_[0] >> 2; x <= last_[0] >> 2; ++x)
          add(voxels_.blockIndex(x, y, z), within(4 * x, 4 * y, 4 * z));
  }

 private:
  /// Of the voxels that the ball may meet, along an axis.
  void findGaps(double center, int axis) {
    std::vector<double>& gaps = gaps_[axis];
    const auto count = static_cast<std::size_t>(last_[axis] - first_[axis]) + 1;
    if (gaps.size() < count) gaps.resize(count);
    double* const to = gaps.data();
    const double origin = voxels_.origin_[axis];
    for (int i = first_[axis]; i <= last_[axis]; ++i) {
      const double middle = origin + voxels_.side_ * (i + 0.5);
      const double gap = std::max(std::abs(middle - center) - half_, 0.0);
      to[i - first_[axis]] = gap * gap;
    }
  }

  /// The voxels of the block from (x, y, z) on that the ball meets.
  Mask within(int x, int y, int z) const {
    const int fromX = std::max(first_[0], x), toX = std::min(last_[0], x + 3);
    const int fromY = std::max(first_[1], y), toY = std::min(last_[1], y + 3);
    const int fromZ = std::max(first_[2], z), toZ = std::min(last_[2], z + 3);
    const double* const gapsX = gaps_[0].data();
    const double* const gapsY = gaps_[1].data();
    const double* const gapsZ = gaps_[2].data();
    Mask mask = 0;
    for (int k = fromZ; k <= toZ; ++k) {
      const double gapZ = gapsZ[k - first_[2]];
      for (int j = fromY; j <= toY; ++j) {
        const double gapY = gapsY[j - first_[1]];
        Mask row = 0;
        for (int i = fromX; i <= toX; ++i)
          row |= Mask{!(gapsX[i - first_[0]] + gapY + gapZ > most_)} << (i - x);
        mask |= row << (4 * (j - y) + 16 * (k - z));
      }
    }
    return mask;
  }

  /// Neighbours in a cloud mark the same voxels: mostly there is nothing to add.
  void add(std::size_t block, Mask mask) {
    const std::atomic_ref<Mask> known(voxels_.masks_[block]);
    if ((mask & ~known.load(std::memory_order_relaxed)) != 0)
      known.fetch_or(mask, std::memory_order_relaxed);
  }

  Voxels& voxels_;
  double half_;                              ///< m, of a voxel's side, and the slack
  std::array<std::vector<double>, 3> gaps_;  ///< m^2, from the centre, per axis
  std::array<int, 3> first_{}, last_{};      ///< voxels that the ball may meet
  double most_ = 0.0;                        ///< m^2
};

void Voxels::mark(const PointCloud& cloud, Crew& crew) {
  constexpr std::size_t kEach = 4096;
  const std::span<const Vector3d> points = cloud.points();
  crew.forPieces(points.size(), kEach, [&](std::size_t first, std::size_t last) {
    BallMarker marker(*this);
    for (std::size_t i = first; i < last; ++i) marker.mark(points[i], cloud.radius(i));
  });
}

/// Halves the triangle until a piece spans few voxels, or two along each axis if it has no plane to
/// separate them.
void Voxels::mark(const std::array<Vector3d, 3>& corners) {
  const Vector3d sides[3] = {corners[1] - corners[0], corners[2] - corners[1],
                             corners[0] - corners[2]};
  Vector3d normal = sides[0].cross(sides[1]);
  const double longest =
      std::max({sides[0].squaredNorm(), sides[1].squaredNorm(), sides[2].squaredNorm()});
  // If rounding leaves no direction, there is no plane to separate voxels.
  normal = normal.norm() > 1e-3 * longest ? normal.normalized() : Vector3d::Zero();
  struct Piece {
    std::array<Vector3d, 3> corners;
    int depth;
  };
  constexpr int kDeepest = 60;
  constexpr int kMostSpan = 8;
  constexpr int kMostVoxels = 48;
  std::array<Piece, kDeepest + 2> stack;
  int pending = 0;
  stack[pending++] = {corners, 0};
  while (pending > 0) {
    const Piece piece = stack[--pending];
    const auto& [a, b, c] = piece.corners;
    Eigen::Array3i first;
    Eigen::Array3i last;
    if (!voxelsOf(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), first, last)) continue;
    const Eigen::Array3i span = last - first + 1;
    const bool few = !normal.isZero() && (span <= kMostSpan).all() && span.prod() <= kMostVoxels;
    if (few || (span <= 2).all() || piece.depth == kDeepest) {
      markVoxels(first, last, normal, piece.corners);
      continue;
    }
    const double lengths[3] = {(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()};
    const auto side = static_cast<int>(std::max_element(lengths, lengths + 3) - lengths);
    const Vector3d& from = piece.corners[side];
    const Vector3d& to = piece.corners[(side + 1) % 3];
    const Vector3d& apex = piece.corners[(side + 2) % 3];
    const Vector3d half = 0.5 * (from + to);
    stack[pending++] = {{from, half, apex}, piece.depth + 1};
    stack[pending++] = {{half, to, apex}, piece.depth + 1};
  }
}

/// Lemma: two cells (or voxels) that share a face and that no triangle meets are on the same side
/// of every closed component. So one point decides for a whole region of cells, and a voxel that
/// touches such a region belongs to it. Cells that are not reached in this way count as inside.
void Voxels::fill(const TriangleMesh& mesh) {
  const CellGrid grid(blocks_);
  std::vector<std::uint8_t> cells(grid.size(), kUnseen);
  grid.markBorder(cells);
  for (const std::size_t block : surface_) {
    const Mask mask = masks_[block];
    for (int i = 0; i < 8; ++i)
      if ((mask & cellMask(i & 1, i >> 1 & 1, i >> 2)) != 0) cells[grid.cellOf(block, i)] = kMarked;
  }
  fillCells(mesh, grid, cells);
  fillBlocks(grid, cells);
}

void Voxels::fillCells(const TriangleMesh& mesh, const CellGrid& grid,
                       std::vector<std::uint8_t>& cells) {
  constexpr std::size_t kSmallest = 4;  // worth asking about
  constexpr int kMostQuestions = 1000;
  std::vector<std::uint32_t> region;
  const auto visit = [&](std::size_t cell) {
    if (cells[cell] != kUnseen) return;
    cells[cell] = kOutside;
    region.push_back(static_cast<std::uint32_t>(cell));
  };
  int questions = 0;
  for (std::size_t from = 0; from < cells.size(); ++from) {
    if (cells[from] != kUnseen) continue;
    region.clear();
    visit(from);
    for (std::size_t i = 0; i < region.size(); ++i) {
      const std::size_t at = region[i];
      for (const std::size_t step : grid.steps()) {
        visit(at - step);
        visit(at + step);
      }
    }
    bool inside = region.size() < kSmallest || questions == kMostQuestions;
    if (!inside) {
      ++questions;
      inside = mesh.encloses(origin_ + 2.0 * side_ * grid.middleOf(from));
    }
    if (!inside) continue;
    for (const std::uint32_t of : region) cells[of] = kInside;
  }
}

/// Unmarked voxels of a block that are next to outside ones.
Mask Voxels::reached(std::size_t block, const std::vector<Mask>& outside) const {
  const std::size_t nx = blocks_[0];
  const std::size_t layer = nx * blocks_[1];
  const std::size_t x = block % nx;
  const std::size_t y = block / nx % blocks_[1];
  const std::size_t z = block / layer;
  Mask reached = outside[block];
  if (x > 0) reached |= (outside[block - 1] & kLastX) >> 3;
  if (x + 1 < nx) reached |= (outside[block + 1] & kFirstX) << 3;
  if (y > 0) reached |= (outside[block - nx] & kLastY) >> 12;
  if (y + 1 < static_cast<std::size_t>(blocks_[1]))
    reached |= (outside[block + nx] & kFirstY) << 12;
  if (z > 0) reached |= outside[block - layer] >> 48;
  if (z + 1 < static_cast<std::size_t>(blocks_[2])) reached |= outside[block + layer] << 48;
  const Mask free = ~masks_[block];
  reached &= free;
  for (Mask next = grown(reached) & free; next != reached; next = grown(reached) & free)
    reached = next;
  return reached;
}

void Voxels::fillBlocks(const CellGrid& grid, const std::vector<std::uint8_t>& cells) {
  std::vector<Mask> outside(masks_.size(), 0);
  for (std::size_t block = 0; block < masks_.size(); ++block) {
    // The cells of an empty block are on the same side.
    if (masks_[block] == 0) {
      if (cells[grid.cellOf(block, 0)] == kOutside) outside[block] = kFull;
      continue;
    }
    for (int i = 0; i < 8; ++i)
      if (cells[grid.cellOf(block, i)] == kOutside)
        outside[block] |= cellMask(i & 1, i >> 1 & 1, i >> 2);
  }
  // Winding passages may take more rounds than they are worth.
  constexpr int kMostRounds = 64;
  bool changed = true;
  for (int round = 0; changed && round < kMostRounds; ++round) {
    changed = false;
    for (const std::size_t block : surface_) {
      const Mask now = reached(block, outside);
      changed = changed || now != outside[block];
      outside[block] = now;
    }
  }
  for (std::size_t block = 0; block < masks_.size(); ++block) masks_[block] = ~outside[block];
}

}  // namespace swept::detail
