// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simd/compile/row.hpp"
#include "simd/compile/simd_field.hpp"

namespace swept::detail {

/// The bounding shapes of world geometries, one kernel each.
enum class ObstacleKind : std::uint8_t {
  Box,
  Ball,
  Capsule,
  Cylinder,
  Cone,
  Ellipsoid,
  Planes,
  Slab,
  Field
};

/// What a bound on the distance from an obstacle means near it.
enum class NearProof : std::uint8_t {
  None,
  Inside,    ///< if it is zero, the point is in the obstacle, up to rounding
  Distance,  ///< it is the distance of points, up to rounding
  Query,     ///< nothing, but there is a query for it
};

/// { x : |axes[i] . x + offset[i]| <= half[i] }
struct SimdBox {
  float axes[3][3];  ///< unit
  float offset[3];   ///< m
  float half[3];     ///< m
};

/// Sphere, capsule, cylinder or cone about the z axis of a frame.
struct SimdRound {
  float center[3];   ///< m
  float axis[3];     ///< unit; cone: towards the apex
  float halfLength;  ///< m
  float radius;      ///< m
  /// Cone: the side's outward normal, across and along the axis, and its offset. The side is across
  /// * |radial| + along * axial = offset.
  float across = 0.0F;
  float along = 0.0F;
  float offset = 0.0F;  ///< m
};

/// { x : sum of ((axes[i] . x + offset[i]) / semiAxes[i])^2 <= 1 }, and what is nearer than the
/// slack. Longer semi-axes would not do: beside the edge of a flat one they take its surface
/// outwards by next to nothing.
struct SimdEllipsoid {
  float axes[3][3];   ///< unit
  float offset[3];    ///< m
  float semiAxes[3];  ///< m
  float inverse[3];   ///< 1/m, of the semi-axes; need not be exact
  float slack;        ///< m
};

/// { x : normal . x <= offset + slack for all of a range of planes }, or, of a slab,
/// { x : |normal . x - offset| <= slack }
struct LanePlane {
  float normal[3];  ///< unit
  float offset;     ///< m
  float slack;      ///< m
};

/// Each set is larger than the obstacle by at least the rounding of a distance from it in single
/// precision, for points within the robot's reach.
struct SimdObstacle {
  ObstacleKind kind = ObstacleKind::Box;
  NearProof near = NearProof::None;
  std::int32_t first = 0;  ///< into the array of its kind
  std::int32_t count = 1;  ///< planes
};

/// Eight boxes along the axes of the model frame.
struct SimdWorldNode {
  Row lower[3];                ///< m
  Row upper[3];                ///< m
  std::int32_t child[kLanes];  ///< a node's index, or ~index of an obstacle
};

/// The world for the SIMD kernels; indices of obstacles are those of PairModel::worldGeometry.
struct SimdObstacles {
  std::vector<SimdObstacle> obstacles;
  std::vector<SimdBox> boxes;
  std::vector<SimdRound> rounds;
  std::vector<LanePlane> planes;
  std::vector<SimdEllipsoid> ellipsoids;
  std::vector<SimdField> fields;
  std::vector<SimdWorldNode> nodes;  ///< [0] is the root; empty: no obstacles
};

/// `reach`: m, upper bound on the distance of the robot's points from the model frame's origin,
/// without slides. `bounded`: no joint slides freely, the others at most by `farther` (m).
/// `extras`: m, per geometry, how much farther around it the robot must be searched; empty: not at
/// all. `like`: null, or another world, whose fields are shared.
SimdObstacles compileObstacles(const std::vector<WorldGeometry>& world, double reach, bool bounded,
                               std::span<const float> extras = {},
                               const SimdObstacles* like = nullptr, double farther = 0.0);

}  // namespace swept::detail
