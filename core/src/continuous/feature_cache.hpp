// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swept/core/continuous/impact.hpp"

namespace swept::detail {

/// Two features, whichever triangles contain them.
class FeatureKey {
 public:
  /// Of no features.
  FeatureKey() : key_(~std::uint64_t{0}) {}
  static FeatureKey edges(int first, int second) { return FeatureKey(0, first, second); }
  /// `side` distinguishes a vertex of the first mesh from one of the second.
  static FeatureKey vertexFace(int side, int vertex, std::uint32_t face) {
    return FeatureKey(1U + static_cast<unsigned>(side), vertex, static_cast<int>(face));
  }
  bool operator==(const FeatureKey&) const = default;
  std::size_t hash() const { return static_cast<std::size_t>(key_ * 0x9E3779B97F4A7C15U >> 32); }

 private:
  FeatureKey(unsigned kind, int first, int second)
      : key_(std::uint64_t{kind} << 62 | static_cast<std::uint64_t>(first) << 31 |
             static_cast<std::uint64_t>(second)) {}
  std::uint64_t key_;
};

/// Remembers when features meet. Two edges have up to four pairs of triangles around them, which
/// are tested soon after one another: a small cache, which forgets, finds nearly all of them.
class FeatureCache {
 public:
  void clear() { entries_.assign(kEntries, {}); }

  template <typename Solve>
  const Impact& find(const FeatureKey& key, const Solve& solve) {
    Entry& entry = entries_[key.hash() % kEntries];
    if (!(entry.key == key)) entry = {key, solve()};
    return entry.impact;
  }

 private:
  static constexpr std::size_t kEntries = 8192;
  struct Entry {
    FeatureKey key;
    Impact impact;
  };
  std::vector<Entry> entries_;
};

}  // namespace swept::detail
