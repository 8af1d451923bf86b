// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "constraints/constraint_model.hpp"

namespace swept::detail {

struct SimdModel;

/// Joints that carry a vector, from the last common ancestor (exclusive) of carrier and observer.
struct LanePath {
  std::vector<int> bodies;   ///< into SimdModel::bodies, root first
  std::vector<double> arms;  ///< m, or of a direction: L2 of ERROR_MODEL.md; empty: turns alone
};

/// SeenVector in the frames of SimdModel.
struct LaneVector {
  int carrier = 0;  ///< into SimdModel::bodies
  int observer = 0;
  bool isDirection = false;
  float local[3] = {};   ///< m, or a unit vector: carrier's frame
  float origin[3] = {};  ///< m, observer's frame: of the frame in which it is seen
  float axes[9] = {};    ///< that frame from the observer's, row by row
  LanePath carried, observed;
  double magnitude = 1.0;  ///< m, of the numbers that place it; 1 for a direction
};

/// Of a region: the frame of its centre and its half sizes.
struct LaneRegion {
  ConstraintRegion::Type type = ConstraintRegion::Type::Box;
  float axes[9] = {};     ///< row by row: x_region = axes (x - center)
  float center[3] = {};   ///< m
  float size[3] = {};     ///< m, rounded down: half sides; radius; radius and half length
  float rounding = 0.0F;  ///< m, of coordinates in it, as far as it is away
};

/// What the lanes do with a constraint.
enum class LaneTest : std::uint8_t { None, Always, Tilt, Euler, RotationVector, Regions };

/// A constraint in single precision.
struct LaneConstraint {
  LaneTest test = LaneTest::None;
  LaneVector first;   ///< Tilt: the axis; Euler: z; Regions: the point; of vectors: the two bodies
  LaneVector second;  ///< Euler: x
  ///@{
  /// Of the tolerances, in rad. Sines are rounded down, cosines up.
  bool limited[3] = {};
  bool wide[3] = {};  ///< more than a right angle
  float sine[3] = {}, cosine[3] = {};
  float tolerance[3] = {};  ///< rounded down
  ///@}
  /// Of vectors, row by row: B in A R B, the rotation whose vector is meant. A are the axes of
  /// `first`, R is the carrier's rotation as the observer sees it.
  float turn[9] = {};
  std::vector<LaneRegion> regions;
};

/// ConstraintModel for SimdModel's lanes.
struct LaneConstraints {
  std::vector<LaneConstraint> constraints;  ///< empty: the exact tier has them all
};

/// Empty in a tube, where obstacles move, and where lanes know nothing of any constraint.
LaneConstraints compileLaneConstraints(const PairModel& model, const ConstraintModel& constraints,
                                       const SimdModel& simd);

}  // namespace swept::detail
