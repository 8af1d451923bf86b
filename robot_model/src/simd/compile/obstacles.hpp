// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simd/compile/row.hpp"
#include "simd/compile/simd_field.hpp"

namespace swept::detail {

/// What bounds a world geometry from outside, one kernel each.
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

/// What a bound on the distance from an obstacle says of being near it.
enum class NearProof : std::uint8_t {
  None,
  Inside,    ///< where it is zero the point is in the obstacle, but for rounding
  Distance,  ///< it is the distance of points, but for rounding
  Query,     ///< None, but there is a query for it
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
  /// Cone: of the side's outward normal, across and along the axis, and its offset: the side is
  /// across * |radial| + along * axial = offset.
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
  float inverse[3];   ///< 1/m, of the semi-axes; near to them is enough
  float slack;        ///< m
};

/// { x : normal . x <= offset + slack for all of a range of planes }, or, of a slab,
/// { x : |normal . x - offset| <= slack }
struct LanePlane {
  float normal[3];  ///< unit
  float offset;     ///< m
  float slack;      ///< m
};

/// Each set is larger than the obstacle by at least what single precision does to a distance from
/// it, for points within the robot's reach.
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

/// The world in lanes; indices of obstacles are those of PairModel::worldGeometry.
struct SimdObstacles {
  std::vector<SimdObstacle> obstacles;
  std::vector<SimdBox> boxes;
  std::vector<SimdRound> rounds;
  std::vector<LanePlane> planes;
  std::vector<SimdEllipsoid> ellipsoids;
  std::vector<SimdField> fields;
  std::vector<SimdWorldNode> nodes;  ///< [0] is the root; empty: no obstacles
};

/// `reach`: m, no point of the robot is farther from the model frame's origin, but for what slides;
/// `bounded`: none slides freely, the others no farther than by `farther` (m). `extras`: m, per
/// geometry, how much farther around it must be looked for the robot; empty: not at all. `like`:
/// null, or another world, whose fields are shared.
SimdObstacles compileObstacles(const std::vector<WorldGeometry>& world, double reach, bool bounded,
                               std::span<const float> extras = {},
                               const SimdObstacles* like = nullptr, double farther = 0.0);

}  // namespace swept::detail
