// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/patch_cycles.hpp"

#include <algorithm>
#include <bitset>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

namespace swept::detail {
namespace {

constexpr std::size_t kMostPatches = 512;
using PatchSet = std::bitset<kMostPatches>;

/// A basis of the subsets of `count` patches that have an even number of each equation's patches.
std::vector<PatchSet> evenSets(const std::vector<PatchSet>& equations, std::size_t count) {
  std::map<std::size_t, PatchSet> rows;  // by the first patch, which no other row has
  for (PatchSet equation : equations) {
    for (const auto& [pivot, row] : rows)
      if (equation[pivot]) equation ^= row;
    if (equation.none()) continue;
    std::size_t pivot = 0;
    while (!equation[pivot]) ++pivot;
    for (auto& [other, row] : rows)
      if (row[pivot]) row ^= equation;
    rows[pivot] = equation;
  }
  std::vector<PatchSet> basis;
  for (std::size_t free = 0; free < count; ++free) {
    if (rows.contains(free)) continue;
    PatchSet set;
    set.set(free);
    for (const auto& [pivot, row] : rows)
      if (row[free]) set.set(pivot);
    basis.push_back(set);
  }
  return basis;
}

/// Changes one set of a basis so that the sum of all is the set of the largest area. These are
/// mostly the outermost walls, which a count of the crossings of all sets at once then gives.
void sumToLargest(std::vector<PatchSet>& basis, std::span<const double> areas) {
  constexpr std::size_t kMostSets = 10;
  if (basis.empty() || basis.size() > kMostSets) return;
  PatchSet largest;
  double most = 0.0;
  std::size_t used = 0;
  for (std::size_t chosen = 1; chosen < std::size_t{1} << basis.size(); ++chosen) {
    PatchSet set;
    for (std::size_t i = 0; i < basis.size(); ++i)
      if ((chosen >> i & 1) != 0) set ^= basis[i];
    double area = 0.0;
    for (std::size_t patch = 0; patch < areas.size(); ++patch)
      if (set[patch]) area += areas[patch];
    if (!(area > most)) continue;
    most = area;
    largest = set;
    used = chosen;
  }
  for (std::size_t i = 0; i < basis.size(); ++i) {
    if ((used >> i & 1) == 0) continue;
    PatchSet others;
    for (std::size_t j = 0; j < basis.size(); ++j)
      if (j != i) others ^= basis[j];
    basis[i] = largest ^ others;
    return;
  }
}

class Finder {
 public:
  Finder(std::vector<PatchStep> steps, std::span<const double> areas)
      : areas_(areas), root_(areas.size()), open_(areas.size(), false) {
    std::iota(root_.begin(), root_.end(), 0);
    findOdd(std::move(steps));
    leaveLonely();
    for (std::vector<int>& owners : odd_)
      std::erase_if(owners, [&](int patch) { return open_[patch]; });
    // If exactly two patches meet, a set has both of them or neither: they are one piece.
    for (bool joins = true; joins;) {
      findMeetings();
      joins = false;
      for (const std::vector<int>& meeting : meetings_) {
        if (meeting.size() != 2) continue;
        root_[find(meeting[0])] = find(meeting[1]);
        joins = true;
      }
    }
  }

  std::vector<std::vector<int>> cycles() {
    std::map<int, std::vector<int>> pieces;  // patches that are joined, by their root
    for (int patch = 0; patch < static_cast<int>(areas_.size()); ++patch)
      if (!open_[patch]) pieces[find(patch)].push_back(patch);
    for (const std::vector<int>& meeting : meetings_)
      for (const int root : meeting) root_[find(root)] = find(meeting.front());
    std::map<int, std::vector<int>> groups;
    for (const auto& [root, patches] : pieces) groups[find(root)].push_back(root);
    std::map<int, std::vector<const std::vector<int>*>> meetingsOf;
    for (const std::vector<int>& meeting : meetings_)
      meetingsOf[find(meeting.front())].push_back(&meeting);
    std::vector<std::vector<int>> found;
    for (const auto& [root, members] : groups) {
      if (!meetingsOf.contains(root))
        found.push_back(pieces[members.front()]);
      else if (members.size() <= kMostPatches)
        addCycles(members, meetingsOf.at(root), pieces, found);
    }
    return found;
  }

 private:
  int find(int patch) {
    while (root_[patch] != patch) patch = root_[patch] = root_[root_[patch]];
    return patch;
  }

  /// For each step the pieces with an odd number of patches that take it, unless there are none.
  void findMeetings() {
    meetings_.clear();
    for (const std::vector<int>& owners : odd_) {
      std::vector<int> roots;
      for (const int patch : owners) roots.push_back(find(patch));
      std::ranges::sort(roots);
      std::vector<int> meeting;
      for (const int root : roots) {
        if (!meeting.empty() && meeting.back() == root)
          meeting.pop_back();
        else
          meeting.push_back(root);
      }
      if (!meeting.empty()) meetings_.push_back(std::move(meeting));
    }
    std::ranges::sort(meetings_);
    meetings_.erase(std::ranges::unique(meetings_).begin(), meetings_.end());
  }

  /// Per step the patches that take it an odd number of times.
  void findOdd(std::vector<PatchStep> steps) {
    std::ranges::sort(steps);
    for (std::size_t first = 0; first < steps.size();) {
      const std::array<int, 2> ends = steps[first].ends;
      std::vector<int> owners;
      while (first < steps.size() && steps[first].ends == ends) {
        const PatchStep step = steps[first];
        std::size_t times = 0;
        for (; first < steps.size() && steps[first] == step; ++first) ++times;
        if (times % 2 == 1) owners.push_back(step.patch);
      }
      if (!owners.empty()) odd_.push_back(std::move(owners));
    }
  }

  /// A patch with a step that no other patch takes borders a hole. Without it, others may be alone
  /// at their steps.
  void leaveLonely() {
    std::vector<std::vector<std::size_t>> stepsOf(areas_.size());
    std::vector<std::size_t> remaining;
    std::vector<std::size_t> pending;
    for (std::size_t i = 0; i < odd_.size(); ++i) {
      for (const int patch : odd_[i]) stepsOf[patch].push_back(i);
      remaining.push_back(odd_[i].size());
      if (remaining.back() == 1) pending.push_back(i);
    }
    while (!pending.empty()) {
      const std::vector<int>& owners = odd_[pending.back()];
      pending.pop_back();
      for (const int patch : owners) {
        if (open_[patch]) continue;
        open_[patch] = true;
        for (const std::size_t step : stepsOf[patch])
          if (--remaining[step] == 1) pending.push_back(step);
        break;
      }
    }
  }

  void addCycles(const std::vector<int>& members,
                 const std::vector<const std::vector<int>*>& meetings,
                 const std::map<int, std::vector<int>>& pieces,
                 std::vector<std::vector<int>>& found) const {
    std::vector<PatchSet> equations;
    for (const std::vector<int>* meeting : meetings) {
      PatchSet equation;
      for (const int root : *meeting)
        equation.set(
            static_cast<std::size_t>(std::ranges::lower_bound(members, root) - members.begin()));
      equations.push_back(equation);
    }
    std::vector<double> areas;
    for (const int root : members) {
      areas.push_back(0.0);
      for (const int patch : pieces.at(root)) areas.back() += areas_[patch];
    }
    std::vector<PatchSet> basis = evenSets(equations, members.size());
    sumToLargest(basis, areas);
    for (const PatchSet& set : basis) {
      std::vector<int> cycle;
      for (std::size_t i = 0; i < members.size(); ++i) {
        if (!set[i]) continue;
        const std::vector<int>& patches = pieces.at(members[i]);
        cycle.insert(cycle.end(), patches.begin(), patches.end());
      }
      found.push_back(std::move(cycle));
    }
  }

  std::span<const double> areas_;
  std::vector<int> root_;
  std::vector<bool> open_;  ///< in no cycle
  std::vector<std::vector<int>> odd_;
  std::vector<std::vector<int>> meetings_;
};

}  // namespace

std::vector<std::vector<int>> patchCycles(std::vector<PatchStep> steps,
                                          std::span<const double> areas) {
  return Finder(std::move(steps), areas).cycles();
}

}  // namespace swept::detail
