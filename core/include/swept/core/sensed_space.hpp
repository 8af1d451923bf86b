// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "swept/core/point_cloud.hpp"

namespace swept {

/// m. Distance from each of cloud.points() to its k-th nearest other point (k >= 1), without radii.
/// It measures the spacing of samples of a surface: with k = 4, balls of half that distance nearly
/// touch their neighbours. A point whose distance is many times the usual one is probably noise.
/// Infinite for a cloud of k points or fewer. Throws std::invalid_argument for k < 1.
std::vector<double> neighborDistances(const PointCloud& cloud, int k);

/// Balls of different sizes, as PointCloud::build takes them.
struct Balls {
  std::vector<Eigen::Vector3d> centers;  ///< m
  std::vector<double> radii;             ///< m
};

/// The space that a sensor at `sensor` (m) cannot have seen, to be treated as occupied. For each
/// point that the sensor saw, balls follow the ray beyond the point, up to `range` (m) from the
/// sensor. They contain everything that the point's ball of `radius` (m) hides: all points behind
/// it whose straight line to the sensor meets it. Where the balls of neighbouring points overlap,
/// their shadows have no gap. A point at the distance d gives about ln(range / d) d / radius balls,
/// not counting the point's own ball. A point whose ball contains the sensor, or that is out of
/// range, hides nothing.
///
/// Throws std::invalid_argument for numbers that are not finite, for a radius or a range that is
/// not above zero, and when it takes more than ten million balls.
Balls occludedBalls(std::span<const Eigen::Vector3d> points, double radius,
                    const Eigen::Vector3d& sensor, double range);

}  // namespace swept
