// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/json_value.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/joint_trajectory.hpp"

namespace swept {

/// `{"variables", "points": [{"time", "positions", "velocities", "accelerations"}]}`, the last two
/// of a point where it has them.
Json trajectoryJson(const JointTrajectory& trajectory);
/// The reverse. Throws InputError for what is none, or is refused by controllerCurve().
JointTrajectory trajectoryOf(const JsonValue& json);

/// What the tolerances of CheckerOptions::tracking are, `{JOINT: {"rotation", "translation"}}`: of
/// joints of the group, those that are not zero. Mimicking joints follow.
Json trackingJson(const Checker& checker);

}  // namespace swept
