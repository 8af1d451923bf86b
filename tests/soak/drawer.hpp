// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "swept/robot_model/checker.hpp"

namespace soak {

/// Random states and motions of a group, of the kinds that a planner asks about and of those that
/// are hard: anywhere, with joints at their limits, a step from a state asked before, and close to
/// contact, found by bisection from the verdicts that it is told. For one thread.
class Drawer {
 public:
  Drawer(const swept::Checker& checker, std::uint64_t seed);

  void state(std::span<double> q);
  /// What came of a state; to be told of all.
  void learn(std::span<const double> q, swept::Verdict verdict);
  /// An edge as of a planner's tree, or a longer one, or from near contact to near contact.
  void motion(std::span<double> from, std::span<double> to);

 private:
  using State = std::vector<double>;
  /// The last states of a kind; what becomes of them in the next world is another matter.
  struct Recent {
    std::array<State, 16> states;
    unsigned next = 0;
    void add(std::span<const double> q) {
      states[next++ % states.size()].assign(q.begin(), q.end());
    }
  };

  double uniform(double lower, double upper);
  bool oneIn(unsigned count) { return random_() % count == 0; }
  void anywhere(std::span<double> q);
  void someAtLimits(std::span<double> q);
  void recall(const Recent& recent, std::span<double> q);
  /// A step of so many rad or m from `from`, in any direction, and within limits.
  void step(std::span<const double> from, double length, std::span<double> to);
  void bisect(std::span<double> q);
  void between(const State& a, const State& b, std::span<double> q) const;
  void normalise(std::span<double> q) const;

  std::mt19937_64 random_;
  std::vector<double> lower_, upper_;  ///< rad or m
  std::vector<bool> limited_;          ///< by the robot, and not only for these draws
  std::vector<int> orientations_;      ///< where quaternions begin
  Recent free_, blocked_, touching_;
  State open_, shut_;     ///< ends of the way on which contact is looked for
  int halvings_ = 0;      ///< of that way, still to be done
  bool pending_ = false;  ///< its middle was given out, and learn() has not been told of it
  State scratch_;
};

}  // namespace soak
