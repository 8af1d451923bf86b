// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "scenario.hpp"

/// Random motions of a scenario's group, as full states of the oracle. In turn: from anywhere; from
/// a state about to touch, in any direction; and from one such state to another close by, which
/// slides along whatever they touch.
class RandomMotions {
 public:
  /// `skew` >= 1: larger makes more of the lengths, 0.05 to 4 (rad, m), short.
  RandomMotions(const Scenario& scenario, std::uint64_t seed, double skew);
  using Motion = std::pair<std::vector<double>, std::vector<double>>;
  Motion next();
  /// Whether the last motion was of the first kind.
  bool fromAnywhere() const { return (count_ - 1) % 4 < 2; }

 private:
  using State = std::vector<double>;
  double uniform(double lower, double upper);
  State anywhere();
  Eigen::Vector3d nearSomething();  ///< m, model frame
  State freeState();
  double nearness();
  /// A point on the way from `open` to `blocked` where a clearance (m) is just kept, by bisection.
  State lastFree(const State& open, const State& blocked, double clearance) const;
  State nearContact(State& open, State& blocked);
  /// `length` from `from` towards a random state, no further than that state.
  State towards(const State& from, const State& target, double length) const;

  const Scenario& scenario_;
  std::mt19937_64 random_;
  double skew_;
  int count_ = 0;
};
