// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "kinematics/lever_arms.hpp"
#include "simd/compile/row.hpp"
#include "swept/core/shapes.hpp"

namespace swept::detail {

/// Points whose hull, grown by a radius, contains a piece of a link's geometry.
struct SimdHull {
  std::int32_t first = 0;  ///< into SimdHulls::points
  std::int32_t count = 0;  ///< of points; 0: none is known
  float radius = 0.0F;     ///< m
  /// The points belong to the geometry itself, not only to a body around it.
  bool ofGeometry = false;
  std::int32_t firstArm = 0;     ///< into SimdHulls::arms; one for each of SimdModel::ancestors
  std::int32_t firstGrowth = 0;  ///< into SimdHulls::growths
  std::int32_t growthCount = 0;
  /// Lever arms grow by all slides beyond their joints, and there are no growths.
  bool growsByAll = false;
};

/// The hulls of all geometries, in the frames of their bodies.
struct SimdHulls {
  std::vector<SimdHull> of;  ///< per geometry
  /// Eight points each; the last point of a hull is repeated to fill its last row.
  struct Points {
    Row x, y, z;  ///< m
  };
  std::vector<Points> points;
  /// The same in double precision, in the frames of the kinematics: [8 * row + lane].
  std::vector<Eigen::Vector3d> inBody;
  /// m, rounded up: upper bound on the distance of the geometry from the joint's axis while all
  /// prismatic joints are at zero.
  std::vector<float> arms;
  /// See RestArms::Growth; `joint` is an index into SimdModel::ancestors, shares are rounded up.
  struct Growth {
    std::int32_t joint = 0;
    std::int32_t slide = 0;
    float share = 0.0F;
  };
  std::vector<Growth> growths;

  /// `bodyFromLane`: the kinematics' frame of the body from the SIMD tier's frame.
  void add(const Shape& shape, const Eigen::Isometry3d& body_from_shape,
           const Eigen::Matrix3d& bodyFromLane, const RestArms& armsOfPath, bool growsByAll);
};

}  // namespace swept::detail
