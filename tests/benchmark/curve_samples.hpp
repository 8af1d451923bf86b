// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/joint_trajectory.hpp"

/// Random trajectories as a smoother makes them.
namespace swept::benchmark {

/// Knots at equal times, whose velocities wander: joint trajectories with positions and velocities,
/// which a controller makes cubics of.
struct WanderingOptions {
  int pieces = 20;
  double step = 0.1;     ///< s, between two knots
  double keeps = 0.8;    ///< share of a velocity that the next knot keeps
  double change = 0.25;  ///< rad/s or m/s, standard deviation of what comes to it
};

class WanderingTrajectories {
 public:
  /// From free states that are drawn within the limits; where there are none, a turn or 1 m.
  WanderingTrajectories(std::shared_ptr<const Checker> checker, std::uint64_t seed,
                        const WanderingOptions& options = {})
      : checker_(std::move(checker)), workspace_(*checker_), random_(seed), options_(options) {}

  /// At rest in the begin and in the end.
  JointTrajectory draw() {
    JointTrajectory trajectory;
    for (const int variable : checker_->group().variables)
      trajectory.variables.push_back(
          checker_->robot().variables()[static_cast<std::size_t>(variable)].name);
    std::vector<double> q = freeState();
    std::vector<double> velocity(q.size(), 0.0);
    std::normal_distribution<double> normal;
    for (int i = 0; i <= options_.pieces; ++i) {
      trajectory.points.push_back({options_.step * i, q, velocity, {}});
      for (std::size_t k = 0; k < q.size(); ++k) {
        const double next = i + 1 == options_.pieces
                                ? 0.0
                                : options_.keeps * velocity[k] + options_.change * normal(random_);
        q[k] = limited(k, q[k] + 0.5 * options_.step * (velocity[k] + next));
        velocity[k] = next;
      }
    }
    return trajectory;
  }

 private:
  const Variable& variable(std::size_t k) const {
    return checker_->robot().variables()[static_cast<std::size_t>(checker_->group().variables[k])];
  }

  double limited(std::size_t k, double value) const {
    return variable(k).cyclic ? value : std::clamp(value, variable(k).lower, variable(k).upper);
  }

  std::vector<double> freeState() {
    std::vector<double> q(checker_->group().variables.size());
    for (;;) {
      for (std::size_t k = 0; k < q.size(); ++k) {
        const Variable& own = variable(k);
        const bool bounded = !own.cyclic && std::isfinite(own.upper - own.lower);
        const double reach = own.cyclic ? 3.14 : 1.0;
        q[k] = std::uniform_real_distribution<double>(bounded ? own.lower : -reach,
                                                      bounded ? own.upper : reach)(random_);
      }
      if (checker_->checkState(q, workspace_) == Verdict::Free) return q;
    }
  }

  std::shared_ptr<const Checker> checker_;
  Workspace workspace_;
  std::mt19937_64 random_;
  const WanderingOptions options_;
};

}  // namespace swept::benchmark
