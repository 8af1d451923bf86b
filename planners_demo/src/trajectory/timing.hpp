// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/arguments.hpp"
#include "input/task.hpp"
#include "swept/robot_model/rate_limits.hpp"
#include "swept/robot_model/time_parameterization.hpp"

/// How `plan --timed` and `trajectory --repair` time a path.
namespace swept {

/// Those of --limits; without it, the velocities of the URDF.
RateLimits limitsOf(const Arguments& args, const Model& model, const Group& group);

/// The same for a timing: with --max-acceleration where there is no limit, and lowered by --speed.
/// Throws UsageError, beginning with `user` (`--timed`), for the first joint that lacks a limit.
RateLimits timingLimits(const Arguments& args, const Model& model, const Group& group,
                        const char* user);

TimingOptions timingOptions(const Arguments& args);

}  // namespace swept
