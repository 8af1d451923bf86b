// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string_view>

namespace swept::detail {

/// The pose with the rotation nearest to its linear part. Throws std::invalid_argument, naming the
/// argument, if the pose is not finite or its linear part no rotation.
Eigen::Isometry3d checkedPose(const Eigen::Isometry3d& pose, std::string_view name);
Eigen::Matrix3d checkedRotation(const Eigen::Matrix3d& rotation, std::string_view name);

void requireFinite(const Eigen::Vector3d& vector, std::string_view name);

}  // namespace swept::detail
