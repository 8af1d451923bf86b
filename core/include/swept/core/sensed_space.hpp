// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "swept/core/point_cloud.hpp"

namespace swept {

/// m; from each of cloud.points() to the k-th nearest other one (k >= 1), balls not counted. About
/// how far apart samples of a surface are: balls of half of that for k = 4 nearly touch their
/// neighbours, and a point whose distance is many times the usual one is likely to be noise. Of a
/// cloud of k points or fewer infinite. Throws std::invalid_argument for k < 1.
std::vector<double> neighborDistances(const PointCloud& cloud, int k);

/// Balls of different sizes, as PointCloud::build takes them.
struct Balls {
  std::vector<Eigen::Vector3d> centers;  ///< m
  std::vector<double> radii;             ///< m
};

/// What a sensor at `sensor` (m) cannot have seen, to be taken for occupied: for each point that it
/// saw, balls along the ray from the point on, up to `range` (m) from the sensor. They contain
/// whatever the point's ball of `radius` (m) hides, that is all points behind it whose straight way
/// to the sensor meets it. Where the balls of neighbouring points overlap, there is no gap between
/// their shadows. About ln(range / d) d / radius balls for a point at the distance d; those of the
/// points themselves are not among them. A point whose ball contains the sensor, or that is out of
/// range, hides nothing.
///
/// Throws std::invalid_argument for numbers that are not finite, for a radius or a range that is
/// not above zero, and when it takes more than ten million balls.
Balls occludedBalls(std::span<const Eigen::Vector3d> points, double radius,
                    const Eigen::Vector3d& sensor, double range);

}  // namespace swept
