// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace swept::detail {

/// Few of the sets whose union is that of all: greedily the set with the most elements that are
/// still missing (Chvatal 1979, "A greedy heuristic for the set-covering problem"), the first of
/// equals, then without those that later choices made superfluous; or the same with elements that
/// few sets have weighing more, if that gives fewer sets. Elements are 0 to `elements` - 1. The
/// sets chosen, in order of choice.
std::vector<int> greedyCover(int elements, const std::vector<std::vector<int>>& sets);

}  // namespace swept::detail
