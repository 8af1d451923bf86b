// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/checker_results.hpp"
#include "swept/robot_model/configuration.hpp"

namespace swept {

/// The least distances of the checked pairs along a path: the straight motions from each
/// configuration to the next. The result is like Checker::motionClearance over all of them
/// together, with its place on the path. A single configuration is a motion that stays there.
///
/// It takes less time than a loop: motions that stay farther away than others are examined only
/// until that is clear. The cap on intervals applies to each motion. A pair in contact ends the
/// search for its kind: for later pairs of the kind, too, `lower` is 0 and nothing is known.
///
/// `accuracy`: m. Throws std::invalid_argument for no configurations, one of the wrong size, and an
/// accuracy that is not greater than zero.
PathClearance pathClearance(const Checker& checker, const ConfigurationList& states,
                            double accuracy, Workspace& workspace,
                            ClearanceQuery query = ClearanceQuery::ByKind);

}  // namespace swept
