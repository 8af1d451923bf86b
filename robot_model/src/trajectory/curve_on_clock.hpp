// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/schedule.hpp"

namespace swept::detail {

/// A scheduled curve, seen on the clock: its pieces, and rest before and after them.
class CurveOnClock {
 public:
  /// `places`: where its values are in a configuration of the group. Both must outlive this.
  CurveOnClock(const PiecewisePolynomial& curve, double start, double slowdown,
               std::span<const Eigen::Index> places)
      : curve_(&curve), start_(start), slowdown_(slowdown), places_(places) {}
  CurveOnClock(const ScheduledCurve& part, std::span<const Eigen::Index> places)
      : CurveOnClock(part.curve, part.start, part.slowdown, places) {}

  double end() const { return onClock(curve_->end()); }  ///< s
  /// Adds the times (s) strictly between two at which a piece begins or ends.
  void addKnots(double from, double to, std::vector<double>& times) const;
  /// Of what it does between two times without a knot inside.
  int degree(double begin, double end) const;
  /// Writes the rows of its values, of a piece between two such times.
  void write(double begin, double end, Eigen::MatrixXd& piece) const;

 private:
  double onClock(double time) const { return start_ + slowdown_ * time; }
  double ownMiddle(double begin, double end) const;
  bool isAtRest(double begin, double end) const;
  std::size_t pieceOf(double begin, double end) const;

  const PiecewisePolynomial* curve_;
  double start_, slowdown_;
  std::span<const Eigen::Index> places_;
};

/// The curve of a group between two times of the clock, where each part writes its own values, and
/// all others are those of `rest`. Throws std::invalid_argument unless the times increase.
PiecewisePolynomial combined(std::span<const CurveOnClock> parts, const Eigen::VectorXd& rest,
                             double begin, double end);

}  // namespace swept::detail
