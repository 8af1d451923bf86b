// SPDX-License-Identifier: BSD-3-Clause
#include "bench/clock.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace swept {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kCalibration = std::chrono::milliseconds(20);
constexpr int kEmptyReadings = 10000;

}  // namespace

std::uint64_t BenchClock::ticks() {
#if defined(__x86_64__)
  _mm_lfence();
  const std::uint64_t now = __rdtsc();
  _mm_lfence();
  return now;
#else
  return static_cast<std::uint64_t>(Clock::now().time_since_epoch().count());
#endif
}

BenchClock::BenchClock() {
  const auto begin = Clock::now();
  const std::uint64_t first = ticks();
  while (Clock::now() - begin < kCalibration) continue;
  const std::uint64_t last = ticks();
  const double elapsed = std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
  nanosecondsPerTick_ = elapsed / static_cast<double>(last - first);

  overhead_ = std::numeric_limits<std::uint64_t>::max();
  for (int i = 0; i < kEmptyReadings; ++i) {
    const std::uint64_t start = ticks();
    overhead_ = std::min(overhead_, ticks() - start);
  }
}

}  // namespace swept
