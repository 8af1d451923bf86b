// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/valid_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "text/numbers.hpp"

namespace swept::detail {

namespace {

/// Looks at the values of one point. `front`: what messages begin with.
class PointJudge {
 public:
  PointJudge(const std::string& front, std::size_t wanted) : front_(front), wanted_(wanted) {}

  void requireValues(const std::vector<double>& values, const std::string& name) const {
    if (values.size() != wanted_)
      throw std::invalid_argument(front_ + " has " + std::to_string(values.size()) + " " + name +
                                  ", expected " + std::to_string(wanted_));
    if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
      throw std::invalid_argument(front_ + " has " + name + " that are not finite");
  }
  void requireRates(const std::vector<double>& values, const std::string& name) const {
    if (!values.empty()) requireValues(values, name);
  }

 private:
  std::string front_;
  std::size_t wanted_;
};

}  // namespace

void requireValid(const JointTrajectory& trajectory, const char* caller) {
  const std::vector<TrajectoryPoint>& points = trajectory.points;
  const std::string front = std::string(caller) + ": ";
  if (points.empty()) throw std::invalid_argument(front + "the trajectory has no point");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string name = front + "point " + std::to_string(i);
    const PointJudge judge(name, trajectory.variables.size());
    judge.requireValues(points[i].positions, "positions");
    judge.requireRates(points[i].velocities, "velocities");
    judge.requireRates(points[i].accelerations, "accelerations");
    const double before = i == 0 ? 0.0 : points[i - 1].time;
    const double time = points[i].time;
    if (!std::isfinite(time) || !(i == 0 ? time >= 0.0 : time > before))
      throw std::invalid_argument(name + " is at " + formatNumber(time) + " s, allowed is " +
                                  (i == 0 ? "0 or more" : "more than " + formatNumber(before)));
  }
}

}  // namespace swept::detail
