// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

namespace swept::detail {

/// TrajectoryCertificate::violations of a group's curve. `rates`: null, or limits of as many values
/// as the curve has.
std::vector<LimitViolation> limitViolations(const PiecewisePolynomial& curve, const Robot& robot,
                                            const Group& group, const RateLimits* rates);

}  // namespace swept::detail
