// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "certify/pair_query.hpp"

namespace swept::detail {

/// Proves a motion free by adaptive bisection (after Schwarzer, Saha, Latombe 2005), each interval
/// by the pairs' distances at its middle against bounds of their approach; see ApproachBound.
MotionCertificate certifyMotion(const CheckerModel& model, std::span<const double> from,
                                std::span<const double> to, MotionQuery wanted,
                                WorkspaceData& workspace);

MotionClearance motionClearance(const CheckerModel& model, std::span<const double> from,
                                std::span<const double> to, double accuracy, ClearanceQuery wanted,
                                WorkspaceData& workspace);

}  // namespace swept::detail
