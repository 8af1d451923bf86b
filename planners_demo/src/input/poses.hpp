// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>

namespace swept {

/// A unit quaternion qx, qy, qz, qw from numbers typed with a few digits. Throws UsageError, which
/// starts with `what`, where their norm is not close to 1.
Eigen::Vector4d unitQuaternion(const Eigen::Vector4d& typed, const std::string& what);

/// `x,y,z,qx,qy,qz,qw` (m). Throws UsageError, which starts with `label`.
Eigen::Isometry3d readPose(const std::string& text, const std::string& label);

/// The same, or `x,y,z` alone.
Eigen::Isometry3d readPlace(const std::string& text, const std::string& label);

}  // namespace swept
