// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>

#include "swept/robot_model/checker.hpp"

namespace swept {

/// Where a link is to be at the end of a path.
struct PoseTarget {
  std::string link;
  Eigen::Isometry3d model_from_link;
  double positionTolerance;     ///< m
  double orientationTolerance;  ///< rad
};

/// Why the search for goals found no free configuration that has a link there: none that has was
/// found at all, or what is in contact in the one with the least depth, or there is a free one that
/// the search missed.
std::string whyNotReached(const std::shared_ptr<const Checker>& checker, const PoseTarget& target,
                          std::uint32_t seed);

}  // namespace swept
