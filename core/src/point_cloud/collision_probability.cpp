// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/collision_probability.hpp"

#include "point_cloud/probability_goal.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

namespace {

/// NaN compares false, which gives Undecided.
ThresholdResult compared(const CollisionProbability& found, double threshold) {
  ThresholdResult result;
  result.lower = found.lower;
  result.upper = found.upper;
  result.effort = found.effort;
  if (found.lower > threshold) result.answer = Exceeds::Yes;
  if (found.upper <= threshold) result.answer = Exceeds::No;
  return result;
}

}  // namespace

CollisionProbability collisionProbability(const NoisyPointCloud& a, const Shape& b,
                                          const Eigen::Isometry3d& a_from_b,
                                          const CollisionProbabilityOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return collisionProbability(a, b, a_from_b, options); });
  }
  return detail::shapeProbability(a.data(), b, a_from_b, {options, std::nullopt});
}

CollisionProbability collisionProbability(const NoisyPointCloud& a, const NoisyPointCloud& b,
                                          const Eigen::Isometry3d& a_from_b,
                                          const CollisionProbabilityOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return collisionProbability(a, b, a_from_b, options); });
  }
  return detail::cloudProbability(a.data(), b.data(), a_from_b, {options, std::nullopt});
}

ThresholdResult probabilityExceeds(const NoisyPointCloud& a, const Shape& b,
                                   const Eigen::Isometry3d& a_from_b, double threshold,
                                   const CollisionProbabilityOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, threshold] { return probabilityExceeds(a, b, a_from_b, threshold, options); });
  }
  return compared(detail::shapeProbability(a.data(), b, a_from_b, {options, threshold}), threshold);
}

ThresholdResult probabilityExceeds(const NoisyPointCloud& a, const NoisyPointCloud& b,
                                   const Eigen::Isometry3d& a_from_b, double threshold,
                                   const CollisionProbabilityOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, threshold] { return probabilityExceeds(a, b, a_from_b, threshold, options); });
  }
  return compared(detail::cloudProbability(a.data(), b.data(), a_from_b, {options, threshold}),
                  threshold);
}

}  // namespace swept
