// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/checker_results.hpp"
#include "swept/robot_model/configuration.hpp"

namespace swept {

/// How near the checked pairs come on the way through these configurations, by straight motions
/// from each to the next: as Checker::motionClearance of all of them together, with where on the
/// path that is. One configuration alone is a motion on the spot.
///
/// Takes less time than a loop: motions that stay farther away than others come are not looked at
/// more closely than shows that. The cap on intervals counts for each motion. A pair in contact
/// ends the search for its kind: of those after it, too, `lower` is 0 and nothing is known.
///
/// `accuracy`: m. Throws std::invalid_argument for no configurations, one of the wrong size, and an
/// accuracy that is not greater than zero.
PathClearance pathClearance(const Checker& checker, const ConfigurationList& states,
                            double accuracy, Workspace& workspace,
                            ClearanceQuery query = ClearanceQuery::ByKind);

}  // namespace swept
