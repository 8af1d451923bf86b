// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace swept::detail {

/// The i-th of `count` unit vectors that are spread evenly (Gonzalez 2010, Fibonacci lattice).
inline Eigen::Vector3d spreadDirection(int i, int count) {
  const double z = (2.0 * i + 1.0) / count - 1.0;
  const double across = std::sqrt(1.0 - z * z);
  const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
  return {across * std::cos(angle), across * std::sin(angle), z};
}

}  // namespace swept::detail
