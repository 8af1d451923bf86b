// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace swept::detail {

/// The vertices of a hull in the form that support queries read. If there are many, a query reads
/// only those that may be farthest along its direction. Each cell of a cube's surface has its own
/// list; a direction belongs to the cell through which it leaves the cube. Some 200 bytes per point
/// at most.
class SupportPoints {
 public:
  /// `scale`: a power of two that scales coordinates (m) to at most 1 in magnitude. Not empty.
  SupportPoints(std::span<const Eigen::Vector3d> points, double scale);

  /// m, a point farthest along `direction`, up to the rounding of the products: a few ulps of the
  /// coordinates. Along zero: any point.
  Eigen::Vector3d farthest(const Eigen::Vector3d& direction) const;
  /// How many points `farthest` reads.
  std::size_t read(const Eigen::Vector3d& direction) const;
  std::size_t listed() const { return start_.back(); }  ///< entries of all lists

  static constexpr std::size_t kFew = 128;  ///< up to this many points there is one list

 private:
  std::size_t cellOf(const Eigen::Vector3d& direction) const;

  int side_ = 0;                    ///< cells along an edge of the cube; 0: one list
  std::vector<std::size_t> start_;  ///< of each list, in entries, and the end of the last
  /// m. For each list all x, then all y, then all z; filled up to whole SIMD vectors with its first
  /// point.
  std::vector<double> coordinates_;
};

}  // namespace swept::detail
