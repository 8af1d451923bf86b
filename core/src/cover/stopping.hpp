// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/core/enclosing_spheres.hpp"

namespace swept::detail {

/// Asked by loops whose rounds take up to some milliseconds.
inline void throwIfStopped(const StopQuestion& stop) {
  if (stop && stop()) throw SearchStopped();
}

}  // namespace swept::detail
