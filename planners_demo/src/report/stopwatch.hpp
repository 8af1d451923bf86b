// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "bench/clock.hpp"

namespace swept {

/// Time on the processor, ns. Of short work the time-stamp counter tells it exactly; of long work,
/// during which other programs may have had their turn, the thread's own clock.
class Stopwatch {
 public:
  template <typename Work>
  double time(const Work& work) const {
    const double before = threadTime();
    const double passed = clock_.time(work);
    return std::min(passed, threadTime() - before);
  }

 private:
  /// ns
  static double threadTime();

  BenchClock clock_;
};

}  // namespace swept
