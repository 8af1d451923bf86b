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

/// Answers them, each within the budget (see CollisionMatrixOptions::budget), over all values of
/// the robot's variables within their limits. On as many threads as there are processors; the
/// answers are the same on any number.
void proveNever(const Robot& robot, std::span<LinkQuestion> questions, std::int64_t budget);

}  // namespace swept::detail
