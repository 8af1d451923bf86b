// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <iostream>

/// Runs a long campaign a part at a time and prints what came of it after each, failures first.
/// `run` gives the report of one part; returned is that of all.
template <typename Options, typename Run>
auto runInParts(const Options& options, std::uint64_t size, const Run& run) {
  auto total = decltype(run(options)){};
  const std::uint64_t end = options.first + options.count;
  for (Options part = options; part.first < end; part.first += part.count) {
    part.count = std::min(size, end - part.first);
    const auto found = run(part);
    for (const auto& failure : found.failures) std::cout << "  " << failure << std::endl;
    total.add(found);
    std::cout << summary(total) << std::endl;
  }
  return total;
}
