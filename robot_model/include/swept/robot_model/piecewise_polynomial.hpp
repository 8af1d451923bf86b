// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "swept/robot_model/configuration.hpp"

namespace swept {

/// A curve q(t), t in s: between two knots, each value is a polynomial of t.
///
/// A piece has Bernstein coefficients b_0 ... b_d over its own interval [t0, t1]: with u = (t - t0)
/// / (t1 - t0), its value is the sum of C(d, k) u^k (1 - u)^(d - k) b_k. (G. Farin, Curves and
/// Surfaces for CAGD, section 5.1.) A value of a cyclic variable goes the way that its polynomial
/// says.
class PiecewisePolynomial {
 public:
  static constexpr int kMaxDegree = 7;  ///< of a piece

  /// `knots` (s): one more than pieces. `coefficients`: of each piece a matrix with a row for each
  /// value (rad or m) and d + 1 columns. Throws std::invalid_argument unless there is a piece, the
  /// knots increase, all is finite, the degrees are 1 to kMaxDegree, and all pieces have as many
  /// values. The ends of two pieces that meet may differ by rounding only: by 1e-9 of the larger of
  /// 1 and the value.
  PiecewisePolynomial(std::vector<double> knots, std::vector<Eigen::MatrixXd> coefficients);

  /// The curve of a B-spline: `controlPoints` has a column for each, `knots` (s) as many values as
  /// there are columns and degree + 1 more, not descending. It is defined between knots[degree] and
  /// the knot with as many behind it. Throws std::invalid_argument as the constructor does, and for
  /// a knot inside of that range that repeats more often than the degree says.
  static PiecewisePolynomial bSpline(int degree, const std::vector<double>& knots,
                                     const Eigen::MatrixXd& controlPoints);

  ///@{
  /// The number of values; of pieces; and the degree of a piece.
  int dimension() const { return static_cast<int>(coefficients_.front().rows()); }
  std::size_t pieces() const { return coefficients_.size(); }
  int degree(std::size_t piece) const { return static_cast<int>(coefficients_[piece].cols()) - 1; }
  ///@}
  /// s, one more than pieces.
  const std::vector<double>& knots() const { return knots_; }
  /// Of a piece, as the constructor has them.
  const Eigen::MatrixXd& coefficients(std::size_t piece) const { return coefficients_[piece]; }
  double begin() const { return knots_.front(); }                     ///< s
  double end() const { return knots_.back(); }                        ///< s
  double duration() const { return knots_.back() - knots_.front(); }  ///< s

  /// The piece that a time (s) is in: at a knot the later one, beyond the ends the first or last.
  std::size_t pieceAt(double t) const;
  ///@{
  /// At a time (s), which is moved to the nearest end if it is beyond. At a knot, of the later
  /// piece.
  Eigen::VectorXd position(double t) const;      ///< rad or m
  Eigen::VectorXd velocity(double t) const;      ///< rad/s or m/s
  Eigen::VectorXd acceleration(double t) const;  ///< rad/s^2 or m/s^2
  ///@}
  /// The same position, into `q`; allocates nothing. Throws std::invalid_argument for a `q` of
  /// another size.
  void position(double t, ConfigurationSpan q) const;

 private:
  void requireCurves() const;

  std::vector<double> knots_;
  std::vector<Eigen::MatrixXd> coefficients_;
};

}  // namespace swept
