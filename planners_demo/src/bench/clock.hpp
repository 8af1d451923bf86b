// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace swept {

/// Times work of less than a microsecond: the time-stamp counter between fences where there is one,
/// so that nothing of the work before or after slips into the measurement, else the steady clock.
class BenchClock {
 public:
  /// Takes 20 ms: finds the length of a tick and what two readings with nothing between take.
  BenchClock();

  /// ns that `work` took, less the clock's own share; never negative.
  template <typename Work>
  double time(const Work& work) const {
    const std::uint64_t begin = ticks();
    work();
    const std::uint64_t end = ticks();
    const std::uint64_t taken = end - begin;
    return taken > overhead_ ? static_cast<double>(taken - overhead_) * nanosecondsPerTick_ : 0.0;
  }
  /// ns; is left out of what `time` returns.
  double overhead() const { return static_cast<double>(overhead_) * nanosecondsPerTick_; }

 private:
  static std::uint64_t ticks();

  double nanosecondsPerTick_ = 1.0;
  std::uint64_t overhead_ = 0;
};

}  // namespace swept
