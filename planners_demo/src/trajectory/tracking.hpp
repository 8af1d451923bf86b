// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/tracking_tolerance.hpp"

namespace swept {

/// `0.01`, of every joint; `elbow=0.02,base=0.05`, of these; or the first and others behind it. A
/// number is in rad for a joint that turns, in m for one that slides, and both for a planar or
/// floating joint. Throws UsageError for anything else, for a joint that the robot lacks, and for
/// one twice.
TrackingTolerance readTracking(const std::string& text, const Robot& robot);

/// The tolerances at which joint_trajectory_controllers of ros2_control abort:
/// `constraints.JOINT.trajectory` of each controller in a file of parameters. `except`: joints that
/// it does not have to say anything of. Throws InputError for a file without such a controller, a
/// joint of one that the robot lacks, and one without a tolerance, or with 0: its controller never
/// aborts, so it may be anywhere.
TrackingTolerance readControllers(const std::filesystem::path& file, const Robot& robot,
                                  const TrackingTolerance& except);

}  // namespace swept
