// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "broadphase/box_tree.hpp"

namespace swept::detail {

/// Appends the owners of all boxes in the tree that meet `box` (no NaN), in the order of the tree.
/// Touching boxes meet.
void findOverlaps(const BoxTree& tree, const FloatBox& box, std::vector<std::uint32_t>& owners);

}  // namespace swept::detail
