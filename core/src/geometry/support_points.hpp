// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace swept::detail {

/// The vertices of a hull as support queries read them. Of many, a query reads those alone that may
/// be farthest along its direction: directions are told apart by the cell of a cube's surface that
/// they leave through, and each cell has a list of its own. Some 200 bytes a point at most.
class SupportPoints {
 public:
  /// `scale`: a power of two that brings coordinates (m) to at most 1 in magnitude. Not empty.
  SupportPoints(std::span<const Eigen::Vector3d> points, double scale);

  /// m, of the points: one farthest along `direction`, up to the rounding of the products: a few
  /// ulps of the coordinates. Along zero: any.
  Eigen::Vector3d farthest(const Eigen::Vector3d& direction) const;
  /// How many points `farthest` reads.
  std::size_t read(const Eigen::Vector3d& direction) const;
  std::size_t listed() const { return start_.back(); }  ///< entries of all lists

  static constexpr std::size_t kFew = 128;  ///< points, of which there is one list

 private:
  std::size_t cellOf(const Eigen::Vector3d& direction) const;

  int side_ = 0;                    ///< cells along an edge of the cube; 0: one list
  std::vector<std::size_t> start_;  ///< of each list, in entries, and the end of the last
  /// m. For each list all x, then all y, then all z; filled up to whole vectors with its first.
  std::vector<double> coordinates_;
};

}  // namespace swept::detail
