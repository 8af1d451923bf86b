// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace swept {

/// Is told now and then how many questions were answered since the last call, and may throw.
using ReportTick = std::function<void(std::size_t)>;

/// Calls `ask(method, query)` `passes` times for each of both, in turns: a few queries for each
/// method, then the next few, and each time another method first. So what else the machine does
/// hits all methods alike.
template <typename Ask>
void inTurns(std::size_t methods, std::size_t queries, int passes, const Ask& ask,
             const ReportTick& tick) {
  constexpr std::size_t kTurn = 16;  // queries
  std::size_t shift = 0;
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t first = 0; first < queries; first += kTurn, ++shift) {
      const std::size_t last = std::min(first + kTurn, queries);
      for (std::size_t i = 0; i < methods; ++i) {
        for (std::size_t query = first; query < last; ++query) ask((i + shift) % methods, query);
        tick(last - first);
      }
    }
  }
}

}  // namespace swept
