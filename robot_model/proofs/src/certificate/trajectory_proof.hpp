// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

namespace swept {

/// A path file with the proof of a trajectory, or why there is none.
// NOLINTNEXTLINE(bugprone-exception-escape): Json's move is noexcept, which is not believed of it.
struct TrajectoryProof {
  Json path;            ///< see pathJson(), with robot and world
  std::string missing;  ///< see WrittenProof
};

/// Finds it. Throws as writeTrajectoryProof() does, UsageError beginning with `where`.
TrajectoryProof trajectoryProof(const Checker& checker, const JointTrajectory& trajectory,
                                const TrajectoryCertificate& certificate,
                                const std::vector<std::string>& warnings, const std::string& where);

}  // namespace swept
