// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// Two links, and the distance that is to be proven between them.
struct LinkQuestion {
  int linkA = -1;
  int linkB = -1;
  double margin = 0.0;  ///< m
  /// rad. How far beyond their limits the values of joints that turn are looked at, too.
  double beyond = 0.0;
  bool never = false;  ///< proven: always more than the margin apart; see NeverProof
};

/// Answers the questions, each within the budget (see AllowedCollisionMatrixOptions::budget), over
/// all values of the robot's variables within their limits. Links with the fewest joints between
/// them come first, as they can be proven, and with less work. If the next question might exceed
/// `mostWork` (see NeverProof::work()), the rest is left unanswered. Uses this many threads (0: as
/// many as processors); the answers, and the returned work, are the same for any number.
std::int64_t proveNever(const Robot& robot, std::span<LinkQuestion> questions, std::int64_t budget,
                        std::int64_t mostWork, unsigned threads = 0);

}  // namespace swept::detail
