// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>

#include "swept/core/enclosing_spheres.hpp"
#include "verify/check.hpp"

namespace swept {

/// Asked by loops whose rounds take up to some milliseconds.
inline void throwIfStopped(const std::stop_token& stop) {
  if (stop.stop_requested()) throw SearchStopped();
}

/// Lets `stop` end a check, by SearchStopped.
inline verify::Pause pauseOf(const std::stop_token& stop) {
  return [stop] { throwIfStopped(stop); };
}

}  // namespace swept
