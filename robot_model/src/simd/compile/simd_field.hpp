// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "swept/core/bv/aabb.hpp"
#include "swept/core/clearance_field.hpp"
#include "swept/core/shapes.hpp"

namespace swept::detail {

struct WorldGeometry;

/// A ClearanceField for the SIMD kernels, and the shape whose distance it bounds.
struct SimdField {
  float axes[3][3];  ///< unit, of the grid
  float offset[3];   ///< m; the origin of the grid's frame is its corner
  float lower[3];    ///< m
  float upper[3];    ///< m
  float cell;        ///< m
  float inverse;     ///< 1/m, of the cell
  float step;        ///< m, of cells
  float fineStep;    ///< m, of voxels
  float slack;       ///< m, rounding to be subtracted
  std::int32_t blocks[3];
  const std::uint32_t* cells;
  const std::int32_t* bricks;
  const std::uint32_t* voxels;
  std::shared_ptr<const ClearanceField> field;
  Shape shape;
  Eigen::Isometry3d shape_from_world;
  Aabb window;  ///< m, shape's frame: window that the field was built for
};

/// Makes the fields of a world's meshes and clouds; equal ones are shared.
class FieldCompiler {
 public:
  /// `reach`: as for compileObstacles. `room`: m, upper bound on the distance of points of the
  /// robot's balls from the model frame's origin; may be infinite. `known`: fields of another
  /// world, to be shared.
  FieldCompiler(const std::vector<WorldGeometry>& world, double reach, double room,
                std::span<const SimdField> known);

  /// `slack`: m, rounding of a coordinate in a frame of the geometry. False if no point of the
  /// robot comes near the geometry's box.
  bool compile(const WorldGeometry& geometry, double slack, SimdField& lane);

 private:
  /// `box`: m, the shape's.
  std::shared_ptr<const ClearanceField> fieldFor(const Shape& shape, const Aabb& box,
                                                 const Aabb& window);

  struct KnownField {
    const void* data;  ///< of the mesh or cloud
    Aabb window;       ///< m
    std::shared_ptr<const ClearanceField> field;
  };

  double reach_;
  double room_;
  std::size_t cells_ = 0;
  std::vector<KnownField> known_;
};

/// A ball of a cover at one time, and half the path of its centre: x +- g (m, model frame).
struct MovingPoint {
  float x[3];
  float g[3];
};

/// Proves in double precision that no point of the segment is within `radius` (m) of the shape.
/// `outside`: it is known that the shape does not enclose the middle.
bool isApart(const SimdField& field, const MovingPoint& point, float radius, bool outside);
/// Whether the shape is proven to reach within `radius` (m) of the middle.
bool reaches(const SimdField& field, const MovingPoint& point, float radius, bool outside);

}  // namespace swept::detail
