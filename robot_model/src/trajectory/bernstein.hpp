// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "swept/robot_model/piecewise_polynomial.hpp"

namespace swept::detail {

/// Bernstein coefficients of one value over an interval.
using Bernstein = std::array<double, PiecewisePolynomial::kMaxDegree + 1>;

/// The coefficients over [0, u] (`first`) and over [u, 1] (`rest`) of those over [0, 1], by the
/// steps of de Casteljau. u may be outside of [0, 1].
inline void divide(std::span<const double> whole, double u, std::span<double> first,
                   std::span<double> rest) {
  const std::size_t count = whole.size();
  for (std::size_t k = 0; k < count; ++k) rest[k] = whole[k];
  first[0] = rest[0];
  for (std::size_t step = 1; step < count; ++step) {
    for (std::size_t k = 0; k + step < count; ++k) rest[k] += u * (rest[k + 1] - rest[k]);
    first[step] = rest[0];
  }
}

/// The coefficients of the derivative by time of a piece that takes `duration` (s): a row for each
/// value.
inline Eigen::MatrixXd derivative(const Eigen::MatrixXd& piece, double duration) {
  const Eigen::Index degree = piece.cols() - 1;
  if (degree == 0) return Eigen::MatrixXd::Zero(piece.rows(), 1);
  return (piece.rightCols(degree) - piece.leftCols(degree)) *
         (static_cast<double>(degree) / duration);
}

}  // namespace swept::detail
