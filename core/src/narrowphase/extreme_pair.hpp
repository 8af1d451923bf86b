// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "narrowphase/gjk.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept::detail {

/// m. Between these magnitudes the products of up to six coordinates that the pair queries form
/// stay far inside the range of doubles.
inline constexpr double kLeastMagnitude = 1e-30;
inline constexpr double kMostMagnitude = 1e30;

inline bool isExtreme(double magnitude) {
  return !(magnitude > kLeastMagnitude && magnitude < kMostMagnitude);
}

/// Bodies that are extremely small, large or far from each other: the balls around their origins
/// bound the distance from below, any two of their points from above. Both bodies are bounded.
GjkResult extremePair(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b,
                      const Goal& goal);
SignedDistanceResult extremePairSigned(const Convex& a, const Convex& b,
                                       const Eigen::Isometry3d& a_from_b);

}  // namespace swept::detail
