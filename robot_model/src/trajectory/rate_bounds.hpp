// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "swept/robot_model/piecewise_polynomial.hpp"

namespace swept::detail {

///@{
/// What no value of a curve, and no velocity (per s), is larger than, for each of its values: the
/// largest Bernstein coefficient.
std::vector<double> largestValues(const PiecewisePolynomial& curve);
std::vector<double> largestRates(const PiecewisePolynomial& curve);
///@}

}  // namespace swept::detail
