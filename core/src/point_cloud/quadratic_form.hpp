// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "point_cloud/event_integral.hpp"

namespace swept::detail {

/// P(|x| <= radius) for a Gaussian x with this mean (m) and covariance (m^2) in three dimensions,
/// as a series of chi-square distributions with positive weights that sum to one (Ruben:
/// Probability content of regions under spherical normal distributions IV, 1962). The remaining
/// weights bound the remaining terms. If the covariance is nearly singular, or the noise small
/// compared to the mean or the radius, the series is too long, and the bounds stay apart.
/// `rounding`: m, of the mean.
ProbabilityRange withinBall(const Eigen::Vector3d& mean, const Eigen::Matrix3d& covariance,
                            double radius, double rounding);

}  // namespace swept::detail
