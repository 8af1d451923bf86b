// SPDX-License-Identifier: BSD-3-Clause
#include "cover/set_cover.hpp"

#include <algorithm>
#include <utility>

namespace swept::detail {

namespace {

using Sets = std::vector<std::vector<int>>;

/// Greedy choice with a weight per element.
std::vector<int> choose(const std::vector<double>& weights, const Sets& sets) {
  std::vector<int> times(weights.size(), 0);  // covered by the sets chosen
  std::vector<int> chosen;
  std::vector<std::pair<double, int>> heap;  // weight still missing at the last sum, -index
  const auto missing = [&](int index) {
    double sum = 0.0;
    for (const int element : sets[index]) sum += times[element] == 0 ? weights[element] : 0.0;
    return sum;
  };
  for (std::size_t i = 0; i < sets.size(); ++i) {
    heap.emplace_back(missing(static_cast<int>(i)), -static_cast<int>(i));
  }
  std::make_heap(heap.begin(), heap.end());
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end());
    const int index = -heap.back().second;
    heap.pop_back();
    // Gains only shrink, so the first entry of the heap is the best one if it is up to date.
    const std::pair<double, int> now(missing(index), -index);
    if (!(now.first > 0.0)) continue;
    if (!heap.empty() && now < heap.front()) {
      heap.push_back(now);
      std::push_heap(heap.begin(), heap.end());
      continue;
    }
    for (const int element : sets[index]) ++times[element];
    chosen.push_back(index);
  }

  for (auto i = chosen.size(); i-- > 0;) {
    const std::vector<int>& set = sets[chosen[i]];
    if (std::any_of(set.begin(), set.end(), [&](int element) { return times[element] == 1; })) {
      continue;
    }
    for (const int element : set) --times[element];
    chosen.erase(chosen.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return chosen;
}

}  // namespace

std::vector<int> greedyCover(int elements, const Sets& sets) {
  const std::vector<double> equal(static_cast<std::size_t>(elements), 1.0);
  std::vector<double> rare(static_cast<std::size_t>(elements), 0.0);
  for (const std::vector<int>& set : sets) {
    for (const int element : set) rare[element] += 1.0;
  }
  for (double& weight : rare) weight = 1.0 / weight;
  std::vector<int> most = choose(equal, sets);
  std::vector<int> hardest = choose(rare, sets);
  return hardest.size() < most.size() ? hardest : most;
}

}  // namespace swept::detail
