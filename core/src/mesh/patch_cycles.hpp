// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

namespace swept::detail {

/// A step between two points on a patch's border, the smaller point first.
struct PatchStep {
  std::array<int, 2> ends;
  int patch;
  auto operator<=>(const PatchStep&) const = default;
};

/// Sets of patches that bound a solid each: the borders of a set's patches take every step an even
/// number of times. Together they enclose everything that any set with this property encloses.
///
/// `areas`: one per patch. Patches that share a wall are in several sets. A point inside one set
/// is, at most places, inside an odd number of them: of those with the largest area. Linear time,
/// except where an odd number of patches meets, as at such walls. If more than 512 of them are
/// connected, the rest stays open.
std::vector<std::vector<int>> patchCycles(std::vector<PatchStep> steps,
                                          std::span<const double> areas);

}  // namespace swept::detail
