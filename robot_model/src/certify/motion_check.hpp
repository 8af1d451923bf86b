// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <span>

#include "certify/pair_query.hpp"

namespace swept::detail {

/// Proves a motion free, by SimdTier and then ExactTier. Beside moving obstacles it does so part by
/// part, between their waypoints.
MotionCertificate certifyMotion(const CheckerModel& model, const JointPath& path,
                                MotionQuery wanted, WorkspaceData& workspace);
/// The same of the straight motion between two configurations.
MotionCertificate certifyMotion(const CheckerModel& model, std::span<const double> from,
                                std::span<const double> to, MotionQuery wanted,
                                WorkspaceData& workspace);

/// m. Clearances that some other motion has.
struct OtherClearances {
  double world = std::numeric_limits<double>::infinity();  ///< of all pairs, unless by kind
  double self = std::numeric_limits<double>::infinity();   ///< by kind alone
};

/// Pairs that stay at least as far apart as `others` has it are looked at no closer than shows
/// that, and nothing else is said of them: `upper` stays infinite where none comes nearer.
MotionClearance motionClearance(const CheckerModel& model, const JointPath& path, double accuracy,
                                ClearanceQuery wanted, WorkspaceData& workspace,
                                OtherClearances others = {});

}  // namespace swept::detail
