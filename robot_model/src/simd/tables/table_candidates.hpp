// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>
#include "simd/compile/simd_model.hpp"

namespace swept::detail {

struct PairModel;

/// The pairs of bodies for which a joint table is tried, and its resolution.
struct TableCandidates {
  std::vector<std::int32_t> bodyPairs;  ///< indices into SimdModel::bodyPairs, ascending
  int coarseness = 1;                   ///< see TableMotion::between
};

/// Of those with one or two joints that turn between the bodies, `most` at the most: with the
/// fewest joints, and nearest to each other in the reference configuration. The more there are, the
/// coarser each, so that all together take no more memory. `never`, per pair of bodies: needs none.
TableCandidates tableCandidates(const PairModel& model, const SimdModel& simd,
                                const std::vector<char>& never, std::size_t most);

}  // namespace swept::detail
