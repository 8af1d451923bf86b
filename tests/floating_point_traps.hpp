// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cfenv>

namespace swept::test {

/// While it lives, an invalid operation (0 / 0, inf - inf, a comparison of NaN), a division by zero
/// and an overflow of this thread end the process where they happen, with SIGFPE.
class FloatingPointTraps {
 public:
  FloatingPointTraps() {
    std::feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(kTrapped);
  }
  ~FloatingPointTraps() { fedisableexcept(kTrapped); }
  FloatingPointTraps(const FloatingPointTraps&) = delete;
  FloatingPointTraps& operator=(const FloatingPointTraps&) = delete;

  /// Most ARM processors have no traps.
  static bool areSupported() {
    const FloatingPointTraps traps;
    return fegetexcept() == kTrapped;
  }

 private:
  static constexpr int kTrapped = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
};

}  // namespace swept::test
