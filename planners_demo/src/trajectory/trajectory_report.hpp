// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"

/// How `trajectory` prints what is known about a curve.
namespace swept {

/// A trajectory, as it was read, and what was found.
struct TrajectoryReport {
  std::string label;  ///< empty: it is the only one
  std::size_t points = 0;
  double begin = 0.0, end = 0.0;  ///< s, of the curve
  TrajectoryCertificate certificate;
};

/// Several lines.
std::string trajectoryText(const TrajectoryReport& report);
Json trajectoryJson(const TrajectoryReport& report);

}  // namespace swept
