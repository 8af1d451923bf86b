// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/robot_model/checker.hpp"

namespace swept::detail {

/// m. No point of a moving obstacle of the checker's world is farther than this from where it is up
/// to `seconds` earlier or later: the largest of all obstacles. 0 without one.
double largestObstacleRoom(const Checker& checker, double seconds);

/// A checker of the same pairs, each of which keeps so much more from a moving obstacle that what
/// is free beside the obstacles at one time of their clock is free at all times up to `seconds`
/// earlier and later. What it calls a contact may be none.
Checker besideObstaclesWithin(const Checker& checker, double seconds);

}  // namespace swept::detail
