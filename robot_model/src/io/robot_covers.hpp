// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// Gives a cover to each bounded collision geometry that has none. Equal primitives share one, and
/// so do meshes that are copies of each other. Builds covers on this many threads (0: one per
/// processor). The covers do not depend on the number of threads. Rethrows what building one
/// throws.
void addCovers(std::vector<Link>& links, unsigned threads);

}  // namespace swept::detail
