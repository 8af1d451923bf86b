// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace swept::detail {

struct CheckerModel;

/// The frames that move, and all geometry of the robot, of what is attached to it and of the world.
/// What is the same in `like` (may be null; see compileChecker) is taken from there. Throws
/// std::invalid_argument as the constructor of Checker does for attached bodies.
void compileBodies(const CheckerModel* like, CheckerModel& model);

}  // namespace swept::detail
