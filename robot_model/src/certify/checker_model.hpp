// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "constraints/constraint_model.hpp"
#include "model/pair_model.hpp"
#include "simd/compile/lane_constraints.hpp"
#include "simd/compile/simd_model.hpp"
#include "swept/core/broadphase/sweep_and_prune.hpp"

namespace swept::detail {

/// The compiled model of a Checker: the pairs in double precision, and what each tier adds to them.
struct CheckerModel : PairModel {
  /// The world's boxes, for the exact tier; null for a world with few. Handles are indices into
  /// worldGeometry.
  std::shared_ptr<const SweepAndPrune> boxes;
  SimdModel simd;
  ConstraintModel constraints;
  LaneConstraints laneConstraints;
};

/// `like`: null, or an earlier version for the same robot, group and reference.
std::shared_ptr<const CheckerModel> compileChecker(std::shared_ptr<const Robot> robot,
                                                   const Group& group,
                                                   std::shared_ptr<const World> world,
                                                   CheckerOptions options,
                                                   const CheckerModel* like = nullptr);

}  // namespace swept::detail
