// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "joint_space.hpp"
#include "swept/ompl_bridge/nearest_states.hpp"

namespace swept::detail {

/// A k-d tree (Bentley 1975) of weighted joint values in single precision, with leaves of many
/// points, whose distances are computed in lanes. Every cell has the bounding box of its points.
class JointTree::Cells {
 public:
  /// `factors`: of joints beside their weights; none: 1.
  Cells(const JointSpace& space, std::span<const double> factors);

  const JointSpace& space() const { return *space_; }
  void add(const double* values, std::uint32_t index);
  void remove(const double* values, std::uint32_t index);
  void search(const double* values, double within, Candidates& candidates) const;
  std::size_t nearest(const double* values, std::span<std::uint32_t> nearest) const;

 private:
  struct Cell {
    std::vector<float> box;              ///< least values, then greatest
    std::vector<float> blocks;           ///< of a leaf
    std::vector<std::uint32_t> indices;  ///< of a leaf
    std::size_t capacity = 0;            ///< of a leaf, before it is divided
    int axis = 0;
    float middle = 0.0F;         ///< the first child is below it, the second from it on
    std::uint32_t children = 0;  ///< the first of two; 0: a leaf
  };
  /// Most robots' states need no memory of the heap.
  using Point = boost::container::small_vector<float, 16>;
  class Walk;
  class Search;
  class NearestSearch;

  Point weighted(const double* values) const;
  Cell leaf() const;
  void put(Cell& leaf, const float* point, std::uint32_t index) const;
  float coordinate(const Cell& leaf, std::size_t i, std::size_t axis) const;
  void divide(std::size_t cell);

  const JointSpace* space_;
  std::size_t dimension_;
  std::vector<double> scales_;  ///< of joints: weights times factors
  std::vector<Cell> cells_;
  float largest_ = 0.0F;  ///< of all coordinates' magnitudes
};

}  // namespace swept::detail
