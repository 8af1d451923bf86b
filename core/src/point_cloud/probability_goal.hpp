// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "point_cloud/event_integral.hpp"
#include "swept/core/collision_probability.hpp"

namespace swept::detail {

/// Upper bound on the total probability of all points (or pairs) that are far enough to be skipped.
inline constexpr double kFarTail = 1e-9;

/// The goal of a query.
struct ProbabilityGoal {
  CollisionProbabilityOptions options;
  std::optional<double> threshold;  ///< none: the probability itself

  bool isReached(const ProbabilityRange& range) const {
    if (range.gap() <= options.accuracy) return true;
    return threshold && (range.lower > *threshold || range.upper <= *threshold);
  }
};

/// Both set bounds, estimate and effort; [0, 1] for a non-finite pose.
CollisionProbability shapeProbability(const NoisyCloudData& a, const Shape& b,
                                      const Eigen::Isometry3d& a_from_b,
                                      const ProbabilityGoal& goal);
CollisionProbability cloudProbability(const NoisyCloudData& a, const NoisyCloudData& b,
                                      const Eigen::Isometry3d& a_from_b,
                                      const ProbabilityGoal& goal);

}  // namespace swept::detail
