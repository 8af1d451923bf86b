// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/meeting_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace swept::detail {
namespace {

using Eigen::Vector3d;

/// In doubles, as no integer type holds them all. If a coordinate is too large to have neighbours,
/// only equal ones are within the width.
using Cell = std::array<double, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t hash = 0;
    // Adding zero turns -0.0 into 0.0, which has another hash in some libraries.
    for (const double at : cell)
      hash = (hash ^ std::hash<double>{}(at + 0.0)) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(hash ^ hash >> 32);
  }
};

/// Whether the segment comes within `reach` of the box along each axis.
bool passes(const Vector3d& a, const Vector3d& b, const Vector3d& lower, const Vector3d& upper,
            double reach) {
  double enter = 0.0;
  double leave = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = lower[axis] - reach;
    const double high = upper[axis] + reach;
    if (std::max(a[axis], b[axis]) < low || std::min(a[axis], b[axis]) > high) return false;
    const double along = b[axis] - a[axis];
    if (along == 0.0) continue;
    const auto [first, last] = std::minmax({(low - a[axis]) / along, (high - a[axis]) / along});
    enter = std::max(enter, first);
    leave = std::min(leave, last);
  }
  // Rounding moves both by a small part of the segment's length.
  constexpr double kSlack = 1e-12;
  return enter <= leave + kSlack;
}

}  // namespace

std::vector<int> meetingPoints(std::span<const Vector3d> points, std::span<const int> among,
                               double width) {
  // Wide enough that most points find all their neighbours in their own cell.
  const double side = 8.0 * width;
  // The last point of each cell, and per point the one before it; indices into `among`.
  std::unordered_map<Cell, int, CellHash> cells;
  std::vector<int> before(among.size(), -1);
  std::vector<int> met;
  met.reserve(among.size());
  for (std::size_t i = 0; i < among.size(); ++i) {
    const int index = among[i];
    const Vector3d& point = points[index];
    Cell low, own, high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double at = point[static_cast<Eigen::Index>(axis)];
      low[axis] = std::floor((at - width) / side);
      own[axis] = std::floor(at / side);
      high[axis] = std::floor((at + width) / side);
    }
    int nearest = index;
    double least = std::numeric_limits<double>::infinity();
    for (unsigned corner = 0; corner < 8; ++corner) {
      Cell cell;
      bool repeats = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool upper = (corner >> axis & 1u) != 0;
        cell[axis] = upper ? high[axis] : low[axis];
        repeats = repeats || (upper && high[axis] == low[axis]);
      }
      if (repeats) continue;
      const auto found = cells.find(cell);
      if (found == cells.end()) continue;
      for (int at = found->second; at >= 0; at = before[at]) {
        const Vector3d apart = points[among[at]] - point;
        if (apart.cwiseAbs().maxCoeff() > width || !(apart.norm() < least)) continue;
        least = apart.norm();
        nearest = among[at];
      }
    }
    if (nearest == index) {
      const auto [cell, isFirst] = cells.try_emplace(own, static_cast<int>(i));
      if (!isFirst) before[i] = std::exchange(cell->second, static_cast<int>(i));
    }
    met.push_back(nearest);
  }
  return met;
}

PointTree::PointTree(std::span<const Vector3d> points, std::vector<int> among)
    : points_(points), among_(std::move(among)) {
  nodes_.reserve(among_.size());
  if (!among_.empty()) build(0, static_cast<int>(among_.size()));
}

int PointTree::build(int first, int last) {
  Vector3d lower = points_[among_[first]];
  Vector3d upper = lower;
  for (int i = first; i < last; ++i) {
    lower = lower.cwiseMin(points_[among_[i]]);
    upper = upper.cwiseMax(points_[among_[i]]);
  }
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back({lower, upper, first, last - first, -1});
  if (last - first <= kLeaf) return index;
  int axis = 0;
  (0.5 * upper - 0.5 * lower).maxCoeff(&axis);
  const int middle = first + (last - first) / 2;
  std::nth_element(among_.begin() + first, among_.begin() + middle, among_.begin() + last,
                   [&](int a, int b) { return points_[a][axis] < points_[b][axis]; });
  build(first, middle);
  const int right = build(middle, last);
  nodes_[index].right = right;
  return index;
}

void PointTree::near(const Vector3d& a, const Vector3d& b, double reach,
                     std::vector<int>& found) const {
  if (nodes_.empty()) return;
  // Halved at each level: 32 of them hold more points than an int counts.
  std::array<int, 64> stack;
  int pending = 0;
  stack[pending++] = 0;
  while (pending > 0) {
    const int index = stack[--pending];
    const Node& node = nodes_[index];
    if (!passes(a, b, node.lower, node.upper, reach)) continue;
    if (node.right < 0) {
      for (int i = node.first; i < node.first + node.count; ++i) found.push_back(among_[i]);
    } else {
      stack[pending++] = node.right;
      stack[pending++] = index + 1;
    }
  }
}

}  // namespace swept::detail
