// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "point_cloud/certificate.hpp"

namespace swept::detail {

/// Positions as seen by a standard normal vector (u, v, w): mean + axes * (u, v, w).
struct NoiseFrame {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< m
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();  ///< m, a factor of the covariance
  bool isConvex = false;  ///< the positions for which the event occurs are a convex set

  Eigen::Vector3d line(double u, double v) const {  ///< m, its point with w = 0
    return mean + axes.col(0) * u + axes.col(1) * v;
  }
  Eigen::Vector3d way() const { return axes.col(2); }
};

/// The estimated boundary of an event: a tangent plane.
struct BoundaryGuess {
  Eigen::Vector3d point;    ///< m
  Eigen::Vector3d outward;  ///< unit, away from the event
};

/// The lines along w with (u, v) in a rectangle, and the probability in them that an event occurs.
///
/// The bounds are of second order in the rectangle's size. A certificate is convex, so its end
/// along w is a concave function of (u, v), and an affine function below it at the four corners is
/// below it everywhere. The mean of P(z <= affine function) over the rectangle differs from its
/// value at the rectangle's mean by at most half the curvature of the distribution function times
/// the variance of the affine function.
struct LineCell {
  std::array<double, 2> from{};  ///< of u and v
  std::array<double, 2> to{};
  std::array<double, 2> mean{};      ///< of u and v, given that they are in the rectangle
  std::array<double, 2> variance{};  ///< upper bounds on their variances
  double mass = 0.0;                 ///< probability that (u, v) is in the rectangle

  bool looked = false;  ///< positions of its middle line were queried
  std::vector<Certificate> certificates;
  std::optional<BoundaryGuess> boundary;  ///< next to the middle line; for the estimate alone

  double least = 0.0;     ///< probability, proven: (u, v) is in the rectangle and the event occurs
  double most = 0.0;      ///< the same, from above
  double estimate = 0.0;  ///< the same, by the middle line

  double gap() const { return most - least; }

  static LineCell of(const std::array<double, 2>& from, const std::array<double, 2>& to);
};

/// Sets the cell's bounds from its certificates; drops useless certificates.
void bound(const NoiseFrame& frame, LineCell& cell);

/// The unknown part of a cell's middle line with the largest probability.
struct LineGap {
  Interval where;     ///< of w
  double mass = 0.0;  ///< probability of w
};
LineGap widestGap(const NoiseFrame& frame, const LineCell& cell);

}  // namespace swept::detail
