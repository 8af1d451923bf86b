// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>

namespace swept {

/// `x,y,z,qx,qy,qz,qw` (m). Throws UsageError, which starts with `label`.
Eigen::Isometry3d readPose(const std::string& text, const std::string& label);

/// The same, or `x,y,z` alone.
Eigen::Isometry3d readPlace(const std::string& text, const std::string& label);

}  // namespace swept
