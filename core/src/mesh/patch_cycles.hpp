// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

namespace swept::detail {

/// Between two points that a border of a patch leads through, the smaller one first.
struct PatchStep {
  std::array<int, 2> ends;
  int patch;
  auto operator<=>(const PatchStep&) const = default;
};

/// Sets of patches that bound a solid each: every step is taken by the borders of its patches an
/// even number of times. What any set encloses that has this property, one of these does.
///
/// `areas`: one a patch. Patches that share a wall are in several sets. A point inside of one is
/// inside of an odd number of them at most places: of those with the largest area. Takes linear
/// time but where an odd number of patches meets, as at such walls; where more than 512 of them
/// hang together the rest stays open.
std::vector<std::vector<int>> patchCycles(std::vector<PatchStep> steps,
                                          std::span<const double> areas);

}  // namespace swept::detail
