// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/joint_trajectory.hpp"

/// States of a robot that executes a trajectory, somewhere within a tube.
namespace swept::benchmark {

/// Interpolates a message with positions and velocities as ros2_control does, by cubics of its own,
/// and asks a checker without a tube about states every millisecond and milliradian.
class ExecutedSamples {
 public:
  /// `plain`: without a tube. `tube`: rad, of each joint.
  ExecutedSamples(const Checker& plain, double tube, std::uint32_t seed)
      : plain_(plain), workspace_(plain), tube_(tube), random_(seed) {}

  void add(const JointTrajectory& trajectory) {
    const std::int64_t before = hits_;
    for (std::size_t i = 0; i + 1 < trajectory.points.size(); ++i)
      piece(trajectory.points[i], trajectory.points[i + 1]);
    hitCurves_ += hits_ > before ? 1 : 0;
  }

  std::int64_t states() const { return states_; }
  std::int64_t hits() const { return hits_; }
  int hitCurves() const { return hitCurves_; }

 private:
  static constexpr double kTimeStep = 1e-3;   // s
  static constexpr double kJointStep = 1e-3;  // rad

  void piece(const TrajectoryPoint& from, const TrajectoryPoint& to) {
    const double duration = to.time - from.time;
    double fastest = 0.0;  // a bound on the cubic's rate
    for (std::size_t k = 0; k < from.positions.size(); ++k) {
      const double chord = 3.0 * std::abs(to.positions[k] - from.positions[k]) / duration;
      fastest =
          std::max(fastest, chord + std::abs(from.velocities[k]) + std::abs(to.velocities[k]));
    }
    const double step = std::min(kTimeStep, kJointStep / std::max(fastest, 1e-9));
    const int steps = std::max(1, static_cast<int>(std::ceil(duration / step)));
    std::vector<double> q(from.positions.size());
    for (int i = 0; i <= steps; ++i) {
      const double u = static_cast<double>(i) / steps;
      for (std::size_t k = 0; k < q.size(); ++k)
        q[k] = (1.0 + 2.0 * u) * (1.0 - u) * (1.0 - u) * from.positions[k] +
               u * (1.0 - u) * (1.0 - u) * duration * from.velocities[k] +
               u * u * (3.0 - 2.0 * u) * to.positions[k] +
               u * u * (u - 1.0) * duration * to.velocities[k];
      displace(q);
      ++states_;
      hits_ += plain_.checkState(q, workspace_) == Verdict::Collision ? 1 : 0;
    }
  }

  /// To a corner of the tube, or to a place inside of it.
  void displace(std::span<double> q) {
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    const bool corner = random_() % 2 == 0;
    for (double& value : q) {
      const double own = share(random_);
      value += tube_ * (corner ? std::copysign(1.0, own) : own);
    }
  }

  const Checker& plain_;
  Workspace workspace_;
  const double tube_;
  std::mt19937 random_;
  std::int64_t states_ = 0, hits_ = 0;
  int hitCurves_ = 0;
};

}  // namespace swept::benchmark
