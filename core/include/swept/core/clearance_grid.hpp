// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>

#include "swept/core/bv/aabb.hpp"
#include "swept/core/shapes.hpp"

namespace swept {

namespace detail {
struct ClearanceField;
}

/// Where clearances are wanted, and what they may cost.
struct ClearanceGridOptions {
  /// m, the shape's frame: where clearances are wanted. Where it does not meet the shape's box, the
  /// grid is that of the whole shape.
  Aabb window{Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity()),
              Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity())};
  /// About how many at most, of two to four bytes each; 1000 to 2^27. There are fewer where a voxel
  /// would be below 3 mm, or so small that it would take long to mark those that the shape meets.
  std::size_t cells = std::size_t{1} << 19;
};

/// Proven lower bounds of the distance from a triangle mesh (with what it encloses, unless it is
/// MeshInterior::Surface) or a point cloud's balls, looked up in some nanoseconds: a grid of cells,
/// and one of voxels, half as large, near the shape. Immutable; copies share the data. Queries
/// allocate nothing, and any thread may ask.
class ClearanceGrid {
 public:
  /// Throws std::invalid_argument for a shape of another kind, for a window whose lower corner is
  /// not below the upper one or the same, for a number of cells out of range, and for a shape that
  /// reaches beyond 1e30 m within the window, or 1e40 m at all.
  static ClearanceGrid build(const Shape& shape, const ClearanceGridOptions& options = {});

  /// m; the point (m, the shape's frame) is at least this far from the shape, all roundings
  /// included; 0 where it may be in it, and for a point that is not finite.
  ///
  /// How much less than the distance d it can be, for points in box(): at least the lesser of
  /// d - error() and reach(), up to rounding (1e-11 of the coordinates). For a cloud no less than
  /// d - 3.5 voxel() where d is below 4 voxels. Two things count as the shape: everything beyond a
  /// face of box() where the window cut the shape off; and what the triangles of a solid shut off
  /// from the outside where there are less than four cells, or a thousand larger rooms.
  /// For points beyond box(): the root of the sum of the squares of the distance from it and of the
  /// clearance of its nearest point; zero beyond a face where the shape was cut off. That is never
  /// less than the distance from box(). For coordinates above 1e150 m a third of it at least.
  double clearance(const Eigen::Vector3d& point) const;

  /// The same of many, in less than half the time each. Throws std::invalid_argument unless there
  /// are as many bounds.
  void clearances(std::span<const Eigen::Vector3d> points, std::span<double> bounds) const;

  /// Whether the ball (m, the shape's frame) is proven to keep off the shape: clearance(center) >
  /// radius, found sooner. False for what is not a number. Where it is false, isFarther of
  /// segment_query.hpp tells.
  bool isFarther(const Eigen::Vector3d& center, double radius) const;

  double voxel() const;  ///< m, side of a voxel
  /// m, 9 voxels; see clearance(). Of a cloud less than 7.1. The mean is about a quarter of it.
  double error() const;
  double reach() const;     ///< m, 37 voxels; see clearance()
  const Aabb& box() const;  ///< m, around the shape, or its part in the window, and a bit larger
  /// On the heap, of both grids.
  std::size_t bytes() const;
  /// The arrays (clearance_field.hpp).
  const std::shared_ptr<const detail::ClearanceField>& field() const;

 private:
  struct Data;
  explicit ClearanceGrid(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

}  // namespace swept
