// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace swept {

inline double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace swept
