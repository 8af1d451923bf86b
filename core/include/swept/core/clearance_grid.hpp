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

/// Options of ClearanceGrid::build().
struct ClearanceGridOptions {
  /// m, the shape's frame: the region of interest. If it does not meet the shape's box, the grid
  /// covers the whole shape.
  Aabb window{Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity()),
              Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity())};
  /// About the largest number of cells, of two to four bytes each; 1000 to 2^27. There are fewer if
  /// a voxel would be below 3 mm, or so small that it would take long to mark the occupied voxels.
  std::size_t cells = std::size_t{1} << 19;
};

/// Proven lower bounds of the distance from a triangle mesh (with what it encloses, unless it is
/// MeshInterior::Surface) or from a point cloud's balls. A look-up takes some nanoseconds. There is
/// a grid of cells, and near the shape one of voxels, half as large. Immutable; copies share the
/// data. Queries allocate nothing, and any thread may call them.
class ClearanceGrid {
 public:
  /// Throws std::invalid_argument for a shape of another kind, for a window whose lower corner is
  /// above the upper one, for a number of cells out of range, and for a shape that reaches beyond
  /// 1e30 m within the window, or 1e40 m at all.
  static ClearanceGrid build(const Shape& shape, const ClearanceGridOptions& options = {});

  /// m. Proven lower bound of the distance of `point` (m, the shape's frame) from the shape, all
  /// roundings included. 0 if the point may be in the shape or is not finite.
  ///
  /// For points in box() at distance d, the bound is at least the lesser of d - error() and
  /// reach(), up to rounding (1e-11 of the coordinates). For a cloud it is at least d - 3.5 voxel()
  /// if d is below 4 voxels. Two things count as part of the shape: everything beyond a face of
  /// box() where the window cut the shape off; and space that the triangles of a solid shut off
  /// from the outside, if it has less than four cells, or if there are already a thousand larger
  /// rooms.
  /// For points beyond box(), the bound is the root of the sum of two squares: that of the distance
  /// from box(), and that of the clearance of the nearest point of box(). It is zero beyond a face
  /// where the shape was cut off. It is never less than the distance from box(); for coordinates
  /// above 1e150 m, at least a third of it.
  double clearance(const Eigen::Vector3d& point) const;

  /// m. clearance() of many points, in less than half the time each. Throws std::invalid_argument
  /// unless `bounds` has as many elements as `points`.
  void clearances(std::span<const Eigen::Vector3d> points, std::span<double> bounds) const;

  /// Whether the ball (m, the shape's frame) is proven not to touch the shape: clearance(center) >
  /// radius, but found sooner. False for NaN. If it is false, isFarther() of segment_query.hpp
  /// decides.
  bool isFarther(const Eigen::Vector3d& center, double radius) const;

  double voxel() const;  ///< m, side of a voxel
  /// m, 9 voxels; see clearance(). For a cloud less than 7.1. The mean error is about a quarter of
  /// it.
  double error() const;
  double reach() const;     ///< m, 37 voxels; see clearance()
  const Aabb& box() const;  ///< m. Contains the shape, or its part in the window; slightly larger
  /// Bytes on the heap of both grids.
  std::size_t bytes() const;
  /// The arrays (clearance_field.hpp).
  const std::shared_ptr<const detail::ClearanceField>& field() const;

 private:
  struct Data;
  explicit ClearanceGrid(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

}  // namespace swept
