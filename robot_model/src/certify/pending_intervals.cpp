// SPDX-License-Identifier: BSD-3-Clause
#include "certify/pending_intervals.hpp"

#include <algorithm>
#include <tuple>

#include "certify/near_pairs.hpp"

namespace swept::detail {

namespace {

/// The open parts of each pair, one by one.
void listParts(WorkspaceData& workspace) {
  workspace.parts.clear();
  for (const PendingInterval& interval : workspace.pending)
    for (std::size_t i = interval.first; i < interval.first + interval.count; ++i)
      workspace.parts.push_back({workspace.pendingArena[i], interval.begin, interval.end});
}

}  // namespace

void takeAll(const CheckerModel& model, PairQuery& query, WorkspaceData& workspace) {
  workspace.pending.clear();
  query.moveTo(0.5, 0.5);
  NearGeometries(model, query, workspace).collect(0.5, workspace.pendingArena);
  if (!workspace.pendingArena.empty())
    workspace.pending.push_back({0.0, 1.0, 0, workspace.pendingArena.size()});
}

void takeRest(WorkspaceData& workspace) {
  workspace.pending.clear();
  std::swap(workspace.pendingArena, workspace.simd.restArena);
  for (const SimdScratch::Item& item : workspace.simd.rest) {
    const double time = static_cast<double>(item.time);  // dyadic: exact in either precision
    const double half = static_cast<double>(item.half);
    workspace.pending.push_back({time - half, time + half, item.first, item.count});
  }
}

void groupByInterval(WorkspaceData& workspace) {
  listParts(workspace);
  std::ranges::sort(workspace.parts, {}, [](const PendingPart& part) {
    return std::tuple(part.begin, part.end, part.pair);
  });
  auto& groups = workspace.generation;
  auto& arena = workspace.arena;
  groups.clear();
  arena.clear();
  for (const PendingPart& part : workspace.parts) {
    if (groups.empty() || groups.back().begin != part.begin || groups.back().end != part.end)
      groups.push_back({part.begin, part.end, arena.size(), 0});
    arena.push_back(part.pair);
    ++groups.back().count;
  }
}

void stackByTime(WorkspaceData& workspace) {
  auto& stack = workspace.generation;
  auto& arena = workspace.arena;
  stack.clear();
  arena.clear();
  listParts(workspace);
  // From the end of the motion; of intervals that end together, the one that contains the others
  // comes first.
  std::ranges::sort(workspace.parts, {}, [](const PendingPart& part) {
    return std::tuple(-part.end, part.begin, part.pair);
  });
  for (const PendingPart& part : workspace.parts) {
    if (stack.empty() || part.end <= stack.back().begin)
      stack.push_back({part.begin, part.end, arena.size(), 0});
    stack.back().begin = std::min(stack.back().begin, part.begin);
    ++stack.back().count;
    arena.push_back(part.pair);
  }
  std::ranges::sort(workspace.parts, {},
                    [](const PendingPart& part) { return std::tuple(part.pair, part.begin); });
}

OpenPairs sortOpenPairs(const PendingInterval& interval, WorkspaceData& workspace) {
  const auto first = workspace.arena.begin() + static_cast<std::ptrdiff_t>(interval.first);
  const auto last = first + static_cast<std::ptrdiff_t>(interval.count);
  std::sort(first, last);
  const auto end = std::unique(first, last);
  auto& later = workspace.failed;
  later.clear();
  OpenPairs found;
  for (auto at = first; at != end; ++at) {
    bool onAll = false;
    bool onPart = false;
    auto part = std::ranges::lower_bound(workspace.parts, *at, {}, &PendingPart::pair);
    for (; part != workspace.parts.end() && part->pair == *at; ++part) {
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
