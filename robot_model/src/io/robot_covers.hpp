// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// Gives every bounded collision geometry that has none its cover. Equal primitives share one, and
/// so do meshes that are copies of each other. Covers are built on so many threads (0: as many as
/// there are processors) and do not depend on their number; what building one throws is thrown
/// here.
void addCovers(std::vector<Link>& links, unsigned threads);

}  // namespace swept::detail
