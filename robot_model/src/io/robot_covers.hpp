// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// How fine the covers of a robot's geometry are.
inline constexpr double kCoverOverhang = 0.005;       ///< m, of the finest level, but ...
inline constexpr double kCoverRelative = 1.0 / 32.0;  ///< ... not less of the first ball's radius
/// Balls inside a link: where contacts are looked for first.
inline constexpr int kMostInnerBalls = 64;

/// Gives every bounded collision geometry its cover. Equal primitives share one, and so do meshes
/// that are copies of each other. Covers are built on `threads` threads (at least one) and do not
/// depend on their number; what building one throws is thrown here.
void addCovers(std::vector<Link>& links, unsigned threads);

}  // namespace swept::detail
