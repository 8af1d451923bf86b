// SPDX-License-Identifier: BSD-3-Clause
#include "proof/open_work.hpp"

#include <algorithm>
#include <tuple>

namespace swept::detail {

namespace {

void listParts(ProofWork& work) {
  work.parts.clear();
  for (const OpenInterval& interval : work.open.intervals)
    for (const std::uint32_t pair : work.open.pairsOf(interval))
      work.parts.push_back({pair, interval.begin, interval.end});
}

}  // namespace

void groupByInterval(ProofWork& work) {
  listParts(work);
  std::ranges::sort(work.parts, {}, [](const OpenPart& part) {
    return std::tuple(part.begin, part.end, part.pair);
  });
  auto& [groups, pairs] = work.now;
  work.now.clear();
  for (const OpenPart& part : work.parts) {
    if (groups.empty() || groups.back().begin != part.begin || groups.back().end != part.end)
      groups.push_back({part.begin, part.end, pairs.size(), 0});
    pairs.push_back(part.pair);
    ++groups.back().count;
  }
}

void stackByTime(ProofWork& work) {
  auto& [stack, pairs] = work.now;
  work.now.clear();
  listParts(work);
  // From the end of the motion; of intervals that end together, the one that contains the others
  // comes first.
  std::ranges::sort(work.parts, {}, [](const OpenPart& part) {
    return std::tuple(-part.end, part.begin, part.pair);
  });
  for (const OpenPart& part : work.parts) {
    if (stack.empty() || part.end <= stack.back().begin)
      stack.push_back({part.begin, part.end, pairs.size(), 0});
    stack.back().begin = std::min(stack.back().begin, part.begin);
    ++stack.back().count;
    pairs.push_back(part.pair);
  }
  std::ranges::sort(work.parts, {},
                    [](const OpenPart& part) { return std::tuple(part.pair, part.begin); });
}

OpenPairs sortOpenPairs(const OpenInterval& interval, ProofWork& work) {
  const auto first = work.now.pairs.begin() + static_cast<std::ptrdiff_t>(interval.first);
  const auto last = first + static_cast<std::ptrdiff_t>(interval.count);
  std::sort(first, last);
  const auto end = std::unique(first, last);
  auto& later = work.unresolved;
  later.clear();
  OpenPairs found;
  for (auto at = first; at != end; ++at) {
    bool onAll = false;
    bool onPart = false;
    auto part = std::ranges::lower_bound(work.parts, *at, {}, &OpenPart::pair);
    for (; part != work.parts.end() && part->pair == *at; ++part) {
      onAll = onAll || (part->begin <= interval.begin && interval.end <= part->end);
      onPart = onPart || (part->begin < interval.end && interval.begin < part->end);
    }
    if (onAll) {
      first[static_cast<std::ptrdiff_t>(found.onAll++)] = *at;
    } else if (onPart) {
      later.push_back(*at);
    }
  }
  found.onPart = later.size();
  std::ranges::copy(later, first + static_cast<std::ptrdiff_t>(found.onAll));
  return found;
}

}  // namespace swept::detail
