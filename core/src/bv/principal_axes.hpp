// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <span>

namespace swept::detail {

/// m^2; second moments of points about their mean, times their number.
Eigen::Matrix3d scatterOf(std::span<const Eigen::Vector3d> points);

/// Orthonormal columns (up to 1e-15), the direction of most spread first. The accuracy suffices for
/// a good box: axes of similar spread may be mixed. The axes of the frame if no direction stands
/// out or the numbers are out of range.
Eigen::Matrix3d principalAxes(const Eigen::Matrix3d& scatter);

/// Unit vector of most spread.
Eigen::Vector3d principalAxis(const Eigen::Matrix3d& scatter);

/// Orthonormal columns: `first` normalised, and the direction nearest to `second` orthogonal to it,
/// or any if that does not exist.
Eigen::Matrix3d frameAlong(const Eigen::Vector3d& first, const Eigen::Vector3d& second);

/// Columns: along the longest edge, across it in the plane, the normal.
Eigen::Matrix3d triangleAxes(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& c);

}  // namespace swept::detail
