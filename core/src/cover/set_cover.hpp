// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace swept::detail {

/// Few of the sets, with the same union as all of them. Greedy: the set with the most missing
/// elements is next (Chvatal 1979, "A greedy heuristic for the set-covering problem"), the first
/// among equals; then sets that later choices made superfluous are dropped. It also tries larger
/// weights for elements that few sets have, and uses the result with fewer sets. Elements are 0 to
/// `elements` - 1. Returns the chosen sets in order of choice.
std::vector<int> greedyCover(int elements, const std::vector<std::vector<int>>& sets);

}  // namespace swept::detail
