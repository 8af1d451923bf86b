// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>

#include "input/task.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// Where a link is to be at the end of a path.
struct PoseTarget {
  std::string link;
  Eigen::Isometry3d model_from_link;
  double positionTolerance;     ///< m
  double orientationTolerance;  ///< rad
};

/// Why no free configuration is known that has a link there: `link hand cannot be put there, ...`,
/// or what is in contact when it is, with the least depth seen.
std::string whyNotReached(const std::shared_ptr<const Checker>& checker, const PoseTarget& target,
                          std::uint32_t seed);

}  // namespace swept
