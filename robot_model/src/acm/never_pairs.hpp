// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// Two links, and how far they are to be proven apart.
struct LinkQuestion {
  int linkA = -1;
  int linkB = -1;
  double margin = 0.0;  ///< m
  bool never = false;   ///< proven: always more than the margin apart; see NeverProof
};

/// Answers them, each within the budget (see AllowedCollisionMatrixOptions::budget), over all
/// values of the robot's variables within their limits. Those with the fewest joints between the
/// two links come first, as they are the ones that can be proven, and the less work each is; when
/// `mostWork` (see NeverProof::work()) might be passed by the next, the rest is left unanswered. On
/// so many threads (0: as many as there are processors); the answers, and the work that is
/// returned, are the same on any number.
std::int64_t proveNever(const Robot& robot, std::span<LinkQuestion> questions, std::int64_t budget,
                        std::int64_t mostWork, unsigned threads = 0);

}  // namespace swept::detail
