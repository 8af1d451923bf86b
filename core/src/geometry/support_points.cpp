// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/support_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "geometry/farthest_point.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;
using Points = std::span<const Vector3d>;
using List = std::vector<int>;

/// Cells of a face of the cube [-1, 1]^3 reach slightly beyond it, so that the axis through its
/// middle is never in a corner of cells. Flat sides of bodies often face along an axis, and all
/// points of such a side are then in one list, not in four.
constexpr double kWidth = 2.1;

/// A cell of the surface of the cube. Faces: two per axis, the positive one first.
struct Cell {
  int face;
  int row;  ///< along the axis after the face's
  int column;

  std::size_t index(int side) const {
    return (static_cast<std::size_t>(face) * side + row) * side + column;
  }
  bool isOnFace(int side) const { return std::max(row, column) * kWidth / side - 1.0 <= 1.0; }
};

/// Coordinates of (row, column) on a face's lattice of `side` steps.
Vector3d cornerOf(int face, int row, int column, int side) {
  const int axis = face / 2;
  Vector3d corner;
  corner[axis] = face % 2 == 0 ? 1.0 : -1.0;
  corner[(axis + 1) % 3] = row * kWidth / side - 1.0;
  corner[(axis + 2) % 3] = column * kWidth / side - 1.0;
  return corner;
}

/// Extent of the points along the corners of a cell, one row each.
using Along = std::array<std::span<const double>, 4>;

/// The points of `list` that may be the farthest along a direction of a cell. Points are at most 1
/// in magnitude.
///
/// Lemma: a direction of the cell is a sum of its corners with weights of at least zero. If a point
/// p is less far than q along every corner, it is less far than q along every direction of the
/// cell.
List farthestOfCell(const List& list, const Along& along) {
  // Two sums of three products are each off by less than 2e-15, and a direction may be up to 2e-15
  // beside its cell, where two points are at most 3.5 apart.
  constexpr double kRounding = 2e-14;
  // The farthest point along each corner, and along their middle.
  constexpr int kBest = 5;
  std::array<std::size_t, kBest> best{};
  std::array<double, kBest> most;
  most.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::array<double, kBest> far{along[0][i], along[1][i], along[2][i], along[3][i],
                                        (along[0][i] + along[1][i]) + (along[2][i] + along[3][i])};
    for (int k = 0; k < kBest; ++k) {
      if (far[k] > most[k]) {
        most[k] = far[k];
        best[k] = i;
      }
    }
  }
  std::array<std::array<double, 4>, kBest> needed;
  for (int k = 0; k < kBest; ++k) {
    for (int corner = 0; corner < 4; ++corner)
      needed[k][corner] = along[corner][best[k]] - kRounding;
  }
  List kept(list.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    double ahead = std::numeric_limits<double>::infinity();
    for (const std::array<double, 4>& least : needed) {
      ahead = std::min(ahead, std::max(std::max(along[0][i] - least[0], along[1][i] - least[1]),
                                       std::max(along[2][i] - least[2], along[3][i] - least[3])));
    }
    kept[count] = list[i];
    count += ahead >= 0.0 ? 1 : 0;
  }
  kept.resize(count);
  return kept;
}

/// The four parts of a cell: the lists of points from `list` for them go into `out`, by cells of a
/// cube with `side` cells along an edge.
void divide(Points points, const List& list, Cell cell, int side, std::vector<List>& out) {
  std::vector<double> far(9 * list.size());
  for (int i = 0; i < 9; ++i) {
    const Vector3d corner =
        cornerOf(cell.face, 2 * cell.row + i / 3, 2 * cell.column + i % 3, side);
    for (std::size_t k = 0; k < list.size(); ++k)
      far[i * list.size() + k] = points[list[k]].dot(corner);
  }
  const auto rowOf = [&](int i) {
    return std::span<const double>(far).subspan(i * list.size(), list.size());
  };
  for (int part = 0; part < 4; ++part) {
    const Cell inner{cell.face, 2 * cell.row + part / 2, 2 * cell.column + part % 2};
    if (!inner.isOnFace(side)) continue;
    const int i = 3 * (part / 2) + part % 2;
    out[inner.index(side)] =
        farthestOfCell(list, {rowOf(i), rowOf(i + 1), rowOf(i + 3), rowOf(i + 4)});
  }
}

/// Lists of the cells of a cube with `side` cells along an edge, an even number. They are parts of
/// the lists of a cube with half as many cells, or of the one list of all points.
std::vector<List> refined(Points points, const std::vector<List>& lists, int side) {
  std::vector<List> out(6 * static_cast<std::size_t>(side) * side);
  const int half = side / 2;
  for (int face = 0; face < 6; ++face) {
    for (int row = 0; row < half; ++row) {
      for (int column = 0; column < half; ++column) {
        const Cell cell{face, row, column};
        const List& list = lists.size() == 1 ? lists[0] : lists[cell.index(half)];
        if (!list.empty()) divide(points, list, cell, side, out);
      }
    }
  }
  return out;
}

/// Entries of a list that fill whole vectors.
std::size_t padded(const List& list) {
  return (list.size() + kPointLanes - 1) / kPointLanes * kPointLanes;
}

std::size_t entriesOf(const std::vector<List>& lists) {
  return std::accumulate(lists.begin(), lists.end(), std::size_t{0},
                         [](std::size_t sum, const List& list) { return sum + padded(list); });
}

}  // namespace

SupportPoints::SupportPoints(Points points, double scale) {
  std::vector<List> lists(1, List(points.size()));
  std::iota(lists[0].begin(), lists[0].end(), 0);
  if (points.size() > kFew) {
    constexpr std::size_t kShort = 32;  // entries on average: shorter lists save little
    constexpr std::size_t kMost = 8;    // entries per point
    constexpr int kFinest = 256;
    std::vector<Vector3d> scaled;
    scaled.reserve(points.size());
    for (const Vector3d& p : points) scaled.push_back(scale * p);
    for (int side = 2; side <= kFinest && entriesOf(lists) > kShort * lists.size(); side *= 2) {
      std::vector<List> finer = refined(scaled, lists, side);
      if (entriesOf(finer) > kMost * points.size()) break;
      lists = std::move(finer);
      side_ = side;
    }
  }
  start_.push_back(0);
  coordinates_.reserve(3 * entriesOf(lists));
  for (const List& list : lists) {
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < padded(list); ++i)
        coordinates_.push_back(points[list[i < list.size() ? i : 0]][axis]);
    }
    start_.push_back(start_.back() + padded(list));
  }
}

std::size_t SupportPoints::cellOf(const Vector3d& direction) const {
  if (side_ == 0) return 0;
  int axis = 0;
  const double most = direction.cwiseAbs().maxCoeff(&axis);
  if (!(most > 0.0)) return 0;
  // NaN has no list.
  const auto place = [&](double across) {
    const double at = side_ / kWidth * (across / most + 1.0);
    return at > 0.0 ? static_cast<int>(at) : 0;
  };
  const Cell cell{2 * axis + (direction[axis] < 0.0 ? 1 : 0), place(direction[(axis + 1) % 3]),
                  place(direction[(axis + 2) % 3])};
  return cell.index(side_);
}

Vector3d SupportPoints::farthest(const Vector3d& direction) const {
  const std::size_t cell = cellOf(direction);
  const std::size_t count = start_[cell + 1] - start_[cell];
  const double* list = coordinates_.data() + 3 * start_[cell];
  const std::size_t found = farthestPoint(list, count, direction.x(), direction.y(), direction.z());
  return {list[found], list[count + found], list[2 * count + found]};
}

std::size_t SupportPoints::read(const Vector3d& direction) const {
  const std::size_t cell = cellOf(direction);
  return start_[cell + 1] - start_[cell];
}

}  // namespace swept::detail
