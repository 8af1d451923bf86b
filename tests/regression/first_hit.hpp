// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "swept/robot_model/checker.hpp"

/// First of the samples every `step` rad or m (of the value that changes most) that is in
/// collision; 2 if none is.
inline double firstHit(const swept::Checker& checker, const std::vector<double>& from,
                       const std::vector<double>& to, double step, swept::Workspace& workspace) {
  double longest = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i)
    longest = std::max(longest, std::abs(to[i] - from[i]));
  const int steps = static_cast<int>(std::ceil(longest / step)) + 1;
  for (int k = 0; k <= steps; ++k) {
    const double t = static_cast<double>(k) / steps;
    const Eigen::VectorXd q = checker.interpolate(from, to, t);
    const std::span<const double> values(q.data(), static_cast<std::size_t>(q.size()));
    if (checker.checkState(values, workspace) == swept::Verdict::Collision) return t;
  }
  return 2.0;
}
