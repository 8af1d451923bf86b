// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/robot_model/piecewise_polynomial.hpp"
#include "trajectory/way_point_path.hpp"

namespace swept::detail {

/// Whether all of a curve's velocities and accelerations keep their limits, and with ramps its
/// jerks, by the Bernstein coefficients of its derivatives.
bool keepsLimits(const PiecewisePolynomial& curve, const VariableLimits& limits);

/// s. The least time between two points with which keepsLimits() is likely to hold for a path that
/// takes up to `duration` (s): what the rounding of positions and times does to accelerations and
/// jerks is then less than VariableLimits::slack of their limits.
double leastStepFor(const WayPointPath& path, double duration);

}  // namespace swept::detail
