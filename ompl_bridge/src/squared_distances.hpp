// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace swept::detail {

/// Points in a block, which holds their first coordinates, then their second, and so on.
constexpr std::size_t kBlock = 16;

/// Squared distances of `count` points in blocks from `point`. Writes them to `squared`, which has
/// room for whole blocks; the rest after the points becomes +infinity. Returns the least.
float squaredDistances(const float* blocks, std::size_t count, const float* point,
                       std::size_t dimension, float* squared);

/// Writes the places of the values that are not above `limit`, which is finite, to `places`, which
/// has room for all. Returns how many. The values are in whole blocks, filled up with +infinity.
std::size_t placesNotAbove(float limit, const float* values, std::size_t count,
                           std::uint32_t* places);

}  // namespace swept::detail
