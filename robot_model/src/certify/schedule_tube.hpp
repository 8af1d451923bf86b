// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/tracking_tolerance.hpp"

namespace swept::detail {

/// The group's values may each be off by so much: what the checker's tube becomes with it. Throws
/// std::invalid_argument for an orientation of a floating joint that is off.
TrackingTolerance widened(const Checker& checker, const std::vector<double>& off);

/// The checker in this tube, with a tolerance in proportion to it: what a wide tube does not prove
/// soon, it rarely proves later, and half of it does. It uses robot and world of `checker`, which
/// must outlive it. Throws likewise.
Checker inTube(const Checker& checker, const std::vector<double>& off);

/// A constant quaternion is copied, and rounds by nothing.
void dropResting(const PiecewisePolynomial& curve, std::vector<double>& off);

}  // namespace swept::detail
