// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/joint_trajectory.hpp"

namespace swept {

/// A proof that robot_model/verify can check.
// NOLINTNEXTLINE(bugprone-exception-escape): Json's move is noexcept, which is not believed of it.
struct Certificate {
  Json model;           ///< what it is about; see modelJson()
  Json proof;           ///< null: there is none
  std::string missing;  ///< why; empty: there is one
};

/// Looks for planes that prove each segment of a path. The checker has proven each segment free
/// before. The planes prove that the bodies of each pair stay farther apart than the margin plus
/// half of the rest of `clearances` (m, one per segment, proven). Bodies out of a link's reach are
/// not part of the clearances; the planes prove that they stay farther apart than the margin.
/// Likewise pairs to which the joints' tolerances leave no more. Throws UsageError for moving
/// obstacles: a path has no times. `lines`: of the path file, see linesJson(); they have to be
/// shown, too. Throws SearchStopped soon after `stop` is requested.
Certificate certificateOf(const Checker& checker, std::span<const std::vector<double>> states,
                          std::span<const double> clearances, const Json& lines = Json::array(),
                          const std::stop_token& stop = {});

/// The same for the curve that a controller makes of a trajectory, between its points. `clearance`:
/// m, of all of it. Variables are those of the group, in its order. `clock`: s, what that of moving
/// obstacles shows at the trajectory's time 0. Throws UsageError for an obstacle that turns by
/// about half a turn between two times without another number between them.
Certificate certificateOf(const Checker& checker, const JointTrajectory& trajectory,
                          double clearance, double clock, const std::stop_token& stop = {});

}  // namespace swept
