// SPDX-License-Identifier: BSD-3-Clause
// What it costs that every function asks for the floating-point environment: where nothing has to
// change, and where the caller has set another one. Exits with 1 where the former takes longer than
// a call may.
#include <cfenv>
#include <cstdio>
#include <vector>

#include "swept/core/floating_point_environment.hpp"
#include "timing.hpp"

namespace swept::benchmark {
namespace {

constexpr int kCalls = 10'000'000;
constexpr double kMostNanoseconds = 10.0;  // of a call

[[gnu::noinline]] void empty() {
  __asm__ volatile("" : : : "memory");
}

/// As functions of swept begin.
[[gnu::noinline]] void guarded() {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([] { return guarded(); });
  }
  __asm__ volatile("" : : : "memory");
}

void repeat(void (*call)()) {
  for (int i = 0; i < kCalls; ++i) call();
}

int run() {
  std::vector<Contestant> contestants{{"no guard", [] { repeat(empty); }},
                                      {"default environment", [] { repeat(guarded); }},
                                      {"rounding upward", [] {
                                         std::fesetround(FE_UPWARD);
                                         repeat(guarded);
                                         std::fesetround(FE_TONEAREST);
                                       }}};
  takeTurns(contestants, 7);
  const auto nanoseconds = [&](std::size_t i) {
    return 1e9 * (contestants[i].seconds - contestants[0].seconds) / kCalls;
  };
  const MarkdownTable table({"caller's environment", "guard, ns per call"});
  table.row({contestants[1].name, number(nanoseconds(1))});
  table.row({contestants[2].name, number(nanoseconds(2))});
  return nanoseconds(1) <= kMostNanoseconds ? 0 : 1;
}

}  // namespace
}  // namespace swept::benchmark

int main() {
  return swept::benchmark::run();
}
