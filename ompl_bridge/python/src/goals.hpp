// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>

namespace swept::python {

/// swept.PoseGoal.
struct PoseTarget {
  std::string link;
  Eigen::Isometry3d model_from_tool, link_from_tool;
  double positionTolerance, orientationTolerance;  ///< m, rad
};

}  // namespace swept::python
