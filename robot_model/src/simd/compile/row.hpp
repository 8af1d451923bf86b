// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace swept::detail {

inline constexpr int kLanes = 8;
inline constexpr std::uint32_t kAllLanes = (1U << kLanes) - 1;

/// One number per lane.
struct alignas(32) Row {
  float lane[kLanes];
};

}  // namespace swept::detail
