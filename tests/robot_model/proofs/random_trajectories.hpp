// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/joint_trajectory.hpp"

namespace swept::test {

/// What the points of a trajectory have besides positions; Mixed: each something else.
enum class Spline : std::uint8_t { Linear, Cubic, Quintic, Mixed };

/// Short trajectories of a group about a state, within limits but for what splines swing beyond.
class RandomTrajectories {
 public:
  RandomTrajectories(const Checker& checker, std::uint64_t seed)
      : checker_(checker), engine_(seed) {}

  double uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(engine_);
  }

  /// Every point is up to `step` (rad, m) from the one before, 0.2 to 1 s later.
  JointTrajectory make(std::vector<double> q, std::size_t points, double step, Spline spline) {
    JointTrajectory trajectory;
    for (const int v : checker_.group().variables)
      trajectory.variables.push_back(variableOf(v).name);
    double time = uniform(0.0, 2.0);
    for (std::size_t i = 0; i < points; ++i) {
      TrajectoryPoint point;
      point.time = time;
      point.positions = q;
      const int kind =
          spline == Spline::Mixed ? static_cast<int>(uniform(0.0, 3.0)) : static_cast<int>(spline);
      if (kind > 0) point.velocities = derivatives(step);
      if (kind > 1) point.accelerations = derivatives(2.0 * step);
      trajectory.points.push_back(std::move(point));
      time += uniform(0.2, 1.0);
      q = near(q, step);
    }
    return trajectory;
  }

 private:
  const Variable& variableOf(int variable) const {
    return checker_.robot().variables()[static_cast<std::size_t>(variable)];
  }
  std::vector<double> near(std::vector<double> q, double step) {
    for (std::size_t i = 0; i < q.size(); ++i) {
      const Variable& variable = variableOf(checker_.group().variables[i]);
      q[i] += uniform(-step, step);
      if (!variable.cyclic) q[i] = std::clamp(q[i], variable.lower, variable.upper);
    }
    return q;
  }
  std::vector<double> derivatives(double most) {
    std::vector<double> values;
    for (int i = 0; i < checker_.dimension(); ++i) values.push_back(uniform(-most, most));
    return values;
  }

  const Checker& checker_;
  std::mt19937_64 engine_;
};

}  // namespace swept::test
