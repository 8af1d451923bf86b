// SPDX-License-Identifier: BSD-3-Clause
#include "page/packed.hpp"

#include <cmath>
#include <limits>

namespace swept {

float roundedDown(double value) {
  const auto nearest = static_cast<float>(value);
  if (!(static_cast<double>(nearest) > value)) return nearest;
  return std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

void appendPose(std::vector<float>& numbers, const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond turn(pose.linear());
  for (const double value : pose.translation()) numbers.push_back(static_cast<float>(value));
  for (const double value : turn.coeffs()) numbers.push_back(static_cast<float>(value));
}

}  // namespace swept
