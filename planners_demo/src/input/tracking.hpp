// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/arguments.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/tracking_tolerance.hpp"

namespace swept {

/// What the joints may be off by: the tolerances of --controllers, and what --tracking says
/// instead.
///
/// --tracking is `0.01`, of every joint; `elbow=0.02,base=0.05`, of these; or the first and others
/// behind it. A number is in rad for a joint that turns, in m for one that slides, and both for a
/// planar or floating joint. Throws UsageError for anything else, for a joint that the robot lacks,
/// and for one twice.
///
/// --controllers is a file of parameters of ros2_control. Its joint_trajectory_controllers abort at
/// `constraints.JOINT.trajectory`. Throws InputError for a file without such a controller, and for
/// a joint of one that the robot lacks. Throws it, too, for a joint without a tolerance, or with 0,
/// unless --tracking names it: its controller never aborts, so it may be anywhere.
TrackingTolerance trackingOf(const Arguments& args, const Robot& robot);

}  // namespace swept
