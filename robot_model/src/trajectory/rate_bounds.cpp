// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/rate_bounds.hpp"

#include <algorithm>

#include "rounding/error_model.hpp"
#include "trajectory/bernstein.hpp"

namespace swept::detail {

namespace {

void enlarge(std::vector<double>& largest, const Eigen::MatrixXd& coefficients) {
  for (Eigen::Index v = 0; v < coefficients.rows(); ++v) {
    double& value = largest[static_cast<std::size_t>(v)];
    value = std::max(value, coefficients.row(v).cwiseAbs().maxCoeff() * kArithmeticOutward);
  }
}

}  // namespace

std::vector<double> largestValues(const PiecewisePolynomial& curve) {
  std::vector<double> largest(static_cast<std::size_t>(curve.dimension()), 0.0);
  for (std::size_t i = 0; i < curve.pieces(); ++i) enlarge(largest, curve.coefficients(i));
  return largest;
}

std::vector<double> largestRates(const PiecewisePolynomial& curve) {
  std::vector<double> largest(static_cast<std::size_t>(curve.dimension()), 0.0);
  for (std::size_t i = 0; i < curve.pieces(); ++i) {
    const double duration = curve.knots()[i + 1] - curve.knots()[i];
    enlarge(largest, derivative(curve.coefficients(i), duration));
  }
  return largest;
}

}  // namespace swept::detail
