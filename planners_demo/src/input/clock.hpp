// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/arguments.hpp"
#include "input/task.hpp"
#include "swept/robot_model/world.hpp"

/// The clock of objects of a scene that move.
namespace swept {

/// s. Times are at most so far from 0.
inline constexpr double kMostTime = 1e6;

/// Throws UsageError where an object of the scene moves, and the subcommand has no clock.
void requireClock(const Arguments& args, const World& world);
/// Throws UsageError for an option of the clock where nothing moves.
void refuseClock(const Arguments& args, const World& world);

/// Gives the states of `check`, `motion` and `view` their times, as the last of their values, where
/// an object of the task's world moves. Throws UsageError where there are no times, another number
/// of them than of states, or a motion would not take time.
void addTimes(const Arguments& args, Task& task);

}  // namespace swept
