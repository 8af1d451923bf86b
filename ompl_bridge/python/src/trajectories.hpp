// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <string>
#include <vector>

#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/rate_limits.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

namespace swept::python {

/// The curve of a swept.Trajectory or a swept.Curve. Throws ArgumentTypeError for all else.
PiecewisePolynomial curveOf(const pybind11::object& trajectory, const char* argument);
/// Of a swept.Trajectory, for whoever has these variables, in this order: throws
/// std::invalid_argument for one of others.
PiecewisePolynomial curveOf(const pybind11::object& trajectory, const char* argument,
                            const std::vector<std::string>& variables);

/// What to find out about a curve, from the arguments of Python. `limits` may be null; `contact`:
/// swept.MotionQuery or None.
TrajectoryQuery queryOf(const RateLimits* limits, double clock, bool clearances,
                        const pybind11::object& contact);

/// Limits of a group from the arguments of Python: each a number for all values, an array (n,), or
/// None, which leaves those of `limits`.
RateLimits limitsOf(RateLimits limits, const pybind11::object& velocity,
                    const pybind11::object& acceleration, const pybind11::object& jerk);

}  // namespace swept::python
