// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

namespace swept {

/// A path file with the proof of a trajectory, with robot and world: see pathJson(). Null if there
/// is no proof; `missing` then says why, as WrittenProof does. Throws as writeTrajectoryProof()
/// does, UsageError beginning with `where`.
Json trajectoryProof(const Checker& checker, const JointTrajectory& trajectory,
                     const TrajectoryCertificate& certificate,
                     const std::vector<std::string>& warnings, double clock,
                     const std::string& where, std::string& missing, const std::stop_token& stop);

}  // namespace swept
