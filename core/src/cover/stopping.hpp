// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>

#include "swept/core/enclosing_spheres.hpp"

namespace swept::detail {

/// Asked by loops whose rounds take up to some milliseconds.
inline void throwIfStopped(const std::stop_token& stop) {
  if (stop.stop_requested()) throw SearchStopped();
}

}  // namespace swept::detail
