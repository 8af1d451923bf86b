// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/timed_path.hpp"

#include <stdexcept>
#include <utility>

#include "trajectory/knots.hpp"
#include "trajectory/rate_check.hpp"
#include "trajectory/whole_times.hpp"

namespace swept::detail {

TimedPath timedPath(const WayPointPath& path, const CornerSpeeds& speeds,
                    const std::vector<std::string>& names, const VariableLimits& limits,
                    double leastStep) {
  constexpr int kTries = 60;
  for (int i = 0; i < kTries; ++i, leastStep *= 2.0) {
    const WholeTimes times = wholeTimes(path, speeds, wholeNanoseconds(leastStep));
    Knots knots = knotsOf(path, speeds, times);
    JointTrajectory trajectory{names, std::move(knots.points)};
    PiecewisePolynomial curve = controllerCurve(trajectory);
    if (keepsLimits(curve, limits))
      return {std::move(trajectory), std::move(curve), std::move(knots.corners)};
  }
  throw std::logic_error("timeParameterize: roundings break a limit, however long a step is");
}

}  // namespace swept::detail
