// SPDX-License-Identifier: BSD-3-Clause
#include "lanes/voxels.hpp"

#include <algorithm>
#include <cmath>

namespace swept::detail {

namespace {

using Eigen::Vector3d;
using Mask = Voxels::Mask;

// Voxels on the faces of a block.
constexpr Mask kFirstX = 0x1111111111111111;
constexpr Mask kLastX = kFirstX << 3;
constexpr Mask kFirstY = 0x000F000F000F000F;
constexpr Mask kLastY = kFirstY << 12;

/// Cells in the floods: marked, or on one side of the surface or the other, or not yet seen.
enum : std::uint8_t { kUnseen, kMarked, kOutside, kInside };

/// With the neighbours within the block.
Mask grown(Mask mask) {
  return mask | (mask & ~kLastX) << 1 | (mask & ~kFirstX) >> 1 | (mask & ~kLastY) << 4 |
         (mask & ~kFirstY) >> 4 | mask << 16 | mask >> 16;
}

}  // namespace

Voxels::Voxels(const Vector3d& origin, double side, const std::array<int, 3>& blocks, double reach)
    : origin_(origin),
      side_(side),
      // Above all rounding of points computed between corners, and of encloses().
      slack_(1e-12 * (reach + origin.lpNorm<1>()) + 1e-9 * side),
      blocks_(blocks) {
  known_.assign(static_cast<std::size_t>(blocks[0]) * blocks[1] * blocks[2], kEmpty);
}

/// Voxels that a box meets; false: none.
bool Voxels::voxelsOf(const Vector3d& lower, const Vector3d& upper, Eigen::Array3i& first,
                      Eigen::Array3i& last) const {
  for (int i = 0; i < 3; ++i) {
    const double from = std::floor((lower[i] - slack_ - origin_[i]) / side_);
    const double to = std::floor((upper[i] + slack_ - origin_[i]) / side_);
    const int count = 4 * blocks_[i];
    if (!(to >= 0.0) || !(from < count)) return false;
    first[i] = static_cast<int>(std::max(from, 0.0));
    last[i] = static_cast<int>(std::min(to, count - 1.0));
  }
  return true;
}

void Voxels::set(int x, int y, int z) {
  const std::size_t block = blockIndex(x / 4, y / 4, z / 4);
  if (known_[block] < 0) {
    known_[block] = static_cast<std::int32_t>(masks_.size());
    masks_.push_back(0);
    blockOf_.push_back(block);
  }
  masks_[known_[block]] |= Mask{1} << (x % 4 + 4 * (y % 4) + 16 * (z % 4));
}

/// Those that the plane through `point` meets; all where the normal is zero.
void Voxels::markVoxels(const Eigen::Array3i& first, const Eigen::Array3i& last,
                        const Vector3d& normal, const Vector3d& point) {
  const double reach = (0.5 * side_ + slack_) * normal.lpNorm<1>();
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) {
        if (!(std::abs(normal.dot(middle(x, y, z) - point)) > reach)) set(x, y, z);
      }
    }
  }
}

void Voxels::mark(const Vector3d& center, double radius) {
  Eigen::Array3i first;
  Eigen::Array3i last;
  const Vector3d reach = Vector3d::Constant(radius);
  if (!voxelsOf(center - reach, center + reach, first, last)) return;
  const double most = (radius + slack_) * (radius + slack_);
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) {
        const Vector3d off = (middle(x, y, z) - center).cwiseAbs();
        const Vector3d gap = (off.array() - (0.5 * side_ + slack_)).max(0.0);
        if (!(gap.squaredNorm() > most)) set(x, y, z);
      }
    }
  }
}

/// Halved until a piece spans two voxels each way, which its plane tells apart.
void Voxels::mark(const std::array<Vector3d, 3>& corners) {
  const Vector3d sides[3] = {corners[1] - corners[0], corners[2] - corners[1],
                             corners[0] - corners[2]};
  Vector3d normal = sides[0].cross(sides[1]);
  const double longest =
      std::max({sides[0].squaredNorm(), sides[1].squaredNorm(), sides[2].squaredNorm()});
  // Where rounding leaves no direction there is no plane to tell voxels apart.
  normal = normal.norm() > 1e-3 * longest ? normal.normalized() : Vector3d::Zero();
  struct Piece {
    std::array<Vector3d, 3> corners;
    int depth;
  };
  constexpr int kDeepest = 60;
  std::array<Piece, kDeepest + 2> stack;
  int pending = 0;
  stack[pending++] = {corners, 0};
  while (pending > 0) {
    const Piece piece = stack[--pending];
    const auto& [a, b, c] = piece.corners;
    Eigen::Array3i first;
    Eigen::Array3i last;
    if (!voxelsOf(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), first, last)) continue;
    if (((last - first) <= 1).all() || piece.depth == kDeepest) {
      markVoxels(first, last, normal, corners[0]);
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
/// of every closed component. So one point tells for a whole region of cells, and a voxel that
/// touches such a region belongs to it. What is not reached this way counts as inside.
void Voxels::fill(const TriangleMesh& mesh) {
  const int nx = 2 * blocks_[0];
  const int ny = 2 * blocks_[1];
  const int nz = 2 * blocks_[2];
  std::vector<std::uint8_t> cells(static_cast<std::size_t>(nx) * ny * nz);
  std::size_t i = 0;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) cells[i++] = cell(x, y, z) ? kMarked : kUnseen;
  fillCells(mesh, cells);
  fillBlocks(cells);
}

void Voxels::fillCells(const TriangleMesh& mesh, std::vector<std::uint8_t>& cells) {
  constexpr std::size_t kSmallest = 4;  // worth asking about
  constexpr int kMostQuestions = 1000;
  const std::size_t nx = 2 * blocks_[0];
  const std::size_t ny = 2 * blocks_[1];
  const std::size_t nz = 2 * blocks_[2];
  const std::size_t layer = nx * ny;
  std::vector<std::size_t> region;
  const auto visit = [&](std::size_t cell) {
    if (cells[cell] != kUnseen) return;
    cells[cell] = kOutside;
    region.push_back(cell);
  };
  int questions = 0;
  for (std::size_t from = 0; from < cells.size(); ++from) {
    region.clear();
    visit(from);
    for (std::size_t i = 0; i < region.size(); ++i) {
      const std::size_t at = region[i];
      const std::size_t x = at % nx;
      const std::size_t y = at / nx % ny;
      const std::size_t z = at / layer;
      if (x > 0) visit(at - 1);
      if (x + 1 < nx) visit(at + 1);
      if (y > 0) visit(at - nx);
      if (y + 1 < ny) visit(at + nx);
      if (z > 0) visit(at - layer);
      if (z + 1 < nz) visit(at + layer);
    }
    if (region.empty()) continue;
    bool inside = region.size() < kSmallest || questions == kMostQuestions;
    if (!inside) {
      ++questions;
      const Eigen::Array3d index(static_cast<double>(from % nx),
                                 static_cast<double>(from / nx % ny),
                                 static_cast<double>(from / layer));
      inside = mesh.encloses(origin_ + (2.0 * side_ * (index + 0.5)).matrix());
    }
    if (!inside) continue;
    for (const std::size_t of : region) cells[of] = kInside;
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
  const Mask free = ~masks_[known_[block]];
  reached &= free;
  for (Mask next = grown(reached) & free; next != reached; next = grown(reached) & free)
    reached = next;
  return reached;
}

void Voxels::fillBlocks(const std::vector<std::uint8_t>& cells) {
  const std::size_t nx = blocks_[0];
  const std::size_t layer = nx * blocks_[1];
  std::vector<Mask> outside(known_.size(), 0);
  for (std::size_t block = 0; block < known_.size(); ++block) {
    const std::size_t cx = 2 * (block % nx);
    const std::size_t cy = 2 * (block / nx % blocks_[1]);
    const std::size_t cz = 2 * (block / layer);
    for (int i = 0; i < 8; ++i) {
      const std::size_t at =
          ((cz + (i >> 2)) * 2 * blocks_[1] + cy + (i >> 1 & 1)) * 2 * nx + cx + (i & 1);
      if (cells[at] == kOutside) outside[block] |= cellMask(i & 1, i >> 1 & 1, i >> 2);
    }
  }
  // Winding passages may take more rounds than they are worth.
  constexpr int kMostRounds = 64;
  bool changed = true;
  for (int round = 0; changed && round < kMostRounds; ++round) {
    changed = false;
    for (const std::size_t block : blockOf_) {
      const Mask now = reached(block, outside);
      changed = changed || now != outside[block];
      outside[block] = now;
    }
  }
  for (std::size_t block = 0; block < known_.size(); ++block) {
    if (known_[block] >= 0)
      masks_[known_[block]] = ~outside[block];
    else if (outside[block] != kFull)
      known_[block] = kSolid;
  }
}

}  // namespace swept::detail
