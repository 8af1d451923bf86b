// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <span>

#include "certify/pair_query.hpp"

namespace swept::detail {

/// Asks SimdTier and then ExactTier about a motion. Beside moving obstacles it does so part by
/// part, between their waypoints.
MotionCertificate certifyMotion(const CheckerModel& model, const JointPath& path,
                                MotionQuery wanted, WorkspaceData& workspace);
/// The same of the straight motion between two configurations.
MotionCertificate certifyMotion(const CheckerModel& model, std::span<const double> from,
                                std::span<const double> to, MotionQuery wanted,
                                WorkspaceData& workspace);

/// Whether the straight motion keeps apart those pairs with the world that the workspace's
/// ProofWork::open lists, on the intervals that it lists: no others are asked about, nor are
/// constraints. The intervals begin at multiples of their lengths, which are powers of two, at
/// least 2^-8. Not for a world with moving obstacles.
Verdict certifyOpen(const CheckerModel& model, std::span<const double> from,
                    std::span<const double> to, WorkspaceData& workspace);

/// m. Clearances of other motions.
struct OtherClearances {
  double world = std::numeric_limits<double>::infinity();  ///< of all pairs, unless by kind
  double self = std::numeric_limits<double>::infinity();   ///< by kind alone
};

/// A pair that stays farther apart than `others` is refined only until that is proven, and the
/// result does not contain it: `upper` stays infinite if no pair comes nearer.
MotionClearance motionClearance(const CheckerModel& model, const JointPath& path, double accuracy,
                                ClearanceQuery wanted, WorkspaceData& workspace,
                                OtherClearances others = {});

}  // namespace swept::detail
