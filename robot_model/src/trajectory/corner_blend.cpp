// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/corner_blend.hpp"

#include <algorithm>
#include <cmath>

namespace swept::detail {

namespace {

/// Directions that are opposite to within this differ by rounding.
constexpr double kOpposite = 1e-6;

/// The largest derivative of u and of 3 u^2 - 2 u^3, and the largest second derivative of the
/// latter.
constexpr double kSteepest = 1.0, kSteepestRamp = 1.5, kSharpestRamp = 6.0;

double square(double x) {
  return x * x;
}

}  // namespace

CornerShape::CornerShape(const WayPointPath& path, std::size_t corner)
    : path_(&path),
      corner_(static_cast<Eigen::Index>(corner)),
      turn_((path.directions.col(corner_) - path.directions.col(corner_ - 1)).norm()),
      mustStop_(path.stops[corner] != 0 ||
                (path.directions.col(corner_) + path.directions.col(corner_ - 1)).norm() <=
                    kOpposite) {}

// Lemma: with A = before f(1 - u) and B = after f(u), the point w - A d1 + B d2 is min(A, B) |d2 -
// d1| from a point of the straight parts, and so is a point of these from it. The minimum is
// largest where A = B. For f(u) = u^2 that is at u0 = 1 / (1 + sqrt(after / before)), with A = B =
// before after / (sqrt(before) + sqrt(after))^2. For 2 u^3 - u^4 = u^2 (1 - (1 - u)^2), it is at
// most the larger of A and B at u0, as A falls and B rises.
double CornerShape::deviation(const CornerBlend& blend) const {
  if (blend.stops()) return 0.0;
  const double roots = std::sqrt(blend.before) + std::sqrt(blend.after);
  double meet = blend.before * blend.after / square(roots);
  if (path_->variables.ramps) {
    const double share = std::sqrt(blend.before) / roots;
    meet *= 1.0 - square(std::min(share, 1.0 - share));
  }
  return meet * turn_;
}

double CornerShape::leastTime(const CornerBlend& blend) const {
  const VariableLimits& limits = path_->variables;
  const auto part = static_cast<std::size_t>(corner_);
  const auto* from = path_->directions.col(corner_ - 1).data();
  const auto* to = path_->directions.col(corner_).data();
  const double time = std::max(2.0 * blend.before / path_->straight[part - 1].speed,
                               2.0 * blend.after / path_->straight[part].speed);
  double squared = square(time);
  double cubed = 0.0;
  for (Eigen::Index j = 0; j < limits.speed.size(); ++j) {
    // The change of velocity, times T.
    const double change = 2.0 * std::abs(blend.after * to[j] - blend.before * from[j]);
    const double steepest = limits.ramps ? kSteepestRamp : kSteepest;
    squared = std::max(squared, steepest * change / limits.acceleration[j]);
    cubed = std::max(cubed, kSharpestRamp * change / limits.jerk[j]);
  }
  return limits.ramps ? std::max(std::sqrt(squared), std::cbrt(cubed)) : std::sqrt(squared);
}

double CornerShape::lengthFor(double speed) const {
  const VariableLimits& limits = path_->variables;
  const auto turn =
      (path_->directions.col(corner_) - path_->directions.col(corner_ - 1)).array().abs();
  // The times that leastTime() asks for, with both lengths b, shall be at most 2 b / speed.
  const double steepest = limits.ramps ? kSteepestRamp : kSteepest;
  double length = 0.5 * steepest * square(speed) * (turn / limits.acceleration.array()).maxCoeff();
  if (limits.ramps) {
    const double sharpest = 0.25 * kSharpestRamp * (turn / limits.jerk.array()).maxCoeff();
    length = std::max(length, std::sqrt(sharpest * speed) * speed);
  }
  return length;
}

Eigen::MatrixXd CornerShape::coefficients(const CornerBlend& blend) const {
  const auto point = path_->points.col(corner_);
  const Eigen::VectorXd before = blend.before * path_->directions.col(corner_ - 1);
  const Eigen::VectorXd after = blend.after * path_->directions.col(corner_);
  Eigen::MatrixXd columns(point.size(), path_->variables.ramps ? 5 : 3);
  const Eigen::Index last = columns.cols() - 1;
  columns.col(0) = point - before;
  columns.col(last / 2) = point;
  columns.col(last) = point + after;
  if (path_->variables.ramps) {
    columns.col(1) = point - 0.5 * before;
    columns.col(3) = point + 0.5 * after;
  }
  return columns;
}

}  // namespace swept::detail
