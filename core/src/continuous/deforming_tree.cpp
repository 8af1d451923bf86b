// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/deforming_tree.hpp"

#include <algorithm>
#include <numeric>

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// Sorts triangles so that those of a block, of eight blocks and so on are near one another.
class Arranger {
 public:
  Arranger(std::span<const Vector3d> points, std::span<const Eigen::Vector3i> triangles,
           std::span<const int> component)
      : component_(component), middles_(triangles.size()), order_(triangles.size()) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      middles_[t].setZero();
      // Scaled first: the sum of three large numbers need not be finite.
      for (const int v : triangles[t]) middles_[t] += points[static_cast<std::size_t>(v)] / 3.0;
    }
    const int pieces = 1 + *std::max_element(component.begin(), component.end());
    pieceMiddles_.assign(static_cast<std::size_t>(pieces), Vector3d::Zero());
    std::vector<double> counts(static_cast<std::size_t>(pieces), 0.0);
    for (const int piece : component) counts[static_cast<std::size_t>(piece)] += 1.0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto piece = static_cast<std::size_t>(component[t]);
      pieceMiddles_[piece] += middles_[t] / counts[piece];
    }
    std::iota(order_.begin(), order_.end(), 0);
  }

  std::vector<int> arranged() {
    std::size_t size = kTreeLanes;
    while (size < order_.size()) size *= kTreeLanes;
    halve(0, order_.size(), size);
    return std::move(order_);
  }

 private:
  /// The largest part is `size`, a power of two. The first half gets size / 2, so that only the
  /// last block of a level is not full.
  void halve(std::size_t first, std::size_t last, std::size_t size) {
    for (; size > kTreeLanes; size /= 2) {
      const std::size_t middle = first + size / 2;
      if (middle >= last) continue;
      part(first, middle, last);
      halve(middle, last, size / 2);
      last = middle;
    }
  }

  void part(std::size_t first, std::size_t middle, std::size_t last) {
    const auto at = [this](std::size_t i) {
      return order_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    const int piece = component_[static_cast<std::size_t>(order_[first])];
    const bool onePiece = std::all_of(at(first), at(last), [this, piece](int t) {
      return component_[static_cast<std::size_t>(t)] == piece;
    });
    const int axis = onePiece ? widestAxis(first, last, [this](int t) { return middleOf(t); })
                              : widestAxis(first, last, [this](int t) { return pieceMiddleOf(t); });
    std::nth_element(at(first), at(middle), at(last), [this, axis](int t, int u) {
      const double pieceT = pieceMiddleOf(t)[axis];
      const double pieceU = pieceMiddleOf(u)[axis];
      if (pieceT != pieceU) return pieceT < pieceU;
      const int p = component_[static_cast<std::size_t>(t)];
      const int q = component_[static_cast<std::size_t>(u)];
      if (p != q) return p < q;
      const double x = middleOf(t)[axis];
      const double y = middleOf(u)[axis];
      return x != y ? x < y : t < u;
    });
  }

  template <typename MiddleOf>
  int widestAxis(std::size_t first, std::size_t last, const MiddleOf& middleOf) const {
    Vector3d lower = middleOf(order_[first]);
    Vector3d upper = lower;
    for (std::size_t i = first; i < last; ++i) {
      lower = lower.cwiseMin(middleOf(order_[i]));
      upper = upper.cwiseMax(middleOf(order_[i]));
    }
    int axis = 0;
    (0.5 * upper - 0.5 * lower).maxCoeff(&axis);
    return axis;
  }

  const Vector3d& middleOf(int t) const { return middles_[static_cast<std::size_t>(t)]; }
  const Vector3d& pieceMiddleOf(int t) const {
    return pieceMiddles_[static_cast<std::size_t>(component_[static_cast<std::size_t>(t)])];
  }

  std::span<const int> component_;
  std::vector<Vector3d> middles_;       ///< m, of triangles
  std::vector<Vector3d> pieceMiddles_;  ///< m
  std::vector<int> order_;
};

std::size_t blocksFor(std::size_t count) {
  return (count + kTreeLanes - 1) / kTreeLanes;
}

}  // namespace

TreeOrder arrangeTriangles(std::span<const Vector3d> points,
                           std::span<const Eigen::Vector3i> triangles,
                           std::span<const int> component, std::span<const std::uint8_t> marks) {
  TreeOrder order;
  order.triangleOf = Arranger(points, triangles, component).arranged();
  order.blocks[0] = blocksFor(triangles.size());
  order.levels = 1;
  // Up to a level with a single lane in use.
  for (std::size_t lanes = triangles.size(); lanes > 1 || order.levels < 2; ++order.levels) {
    lanes = order.blocks[static_cast<std::size_t>(order.levels) - 1];
    order.blocks[static_cast<std::size_t>(order.levels)] = blocksFor(lanes);
  }

  order.vertices.resize(order.blocks[0]);
  order.marked.assign(order.blocks[0], 0);
  std::vector<int> numbered(points.size(), -1);
  for (std::size_t slot = 0; slot < order.blocks[0] * kTreeLanes; ++slot) {
    const std::size_t held = std::min(slot, triangles.size() - 1);
    const auto triangle = static_cast<std::size_t>(order.triangleOf[held]);
    VertexBlock& block = order.vertices[slot / kTreeLanes];
    for (int k = 0; k < 3; ++k) {
      int& number = numbered[static_cast<std::size_t>(triangles[triangle][k])];
      if (number < 0) {
        number = static_cast<int>(order.vertexOf.size());
        order.vertexOf.push_back(triangles[triangle][k]);
      }
      block.of[static_cast<std::size_t>(k)][slot % kTreeLanes] = number;
    }
    if (held == slot && marks[triangle] != 0)
      order.marked[slot / kTreeLanes] |= static_cast<std::uint8_t>(1U << slot % kTreeLanes);
  }
  order.vertexOf.shrink_to_fit();
  return order;
}

}  // namespace swept::detail
