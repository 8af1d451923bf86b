// SPDX-License-Identifier: BSD-3-Clause
#include "report/stopwatch.hpp"

#include <ctime>

namespace swept {

double Stopwatch::threadTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

}  // namespace swept
