// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace swept::detail {

/// Two numbers of boxes, the smaller one in the upper half: sorted as numbers they are sorted as
/// pairs.
using PairKey = std::uint64_t;

inline PairKey pairKey(std::uint32_t a, std::uint32_t b) {
  return a < b ? PairKey{a} << 32 | b : PairKey{b} << 32 | a;
}

/// Sorts by at least this many of the lowest bits of the lower and of the upper half.
void sortPairs(std::vector<PairKey>& keys, int lowerBits, int upperBits,
               std::vector<PairKey>& scratch);

/// Sorted pairs under changes. Recent changes are kept separately as a short sorted list, so that
/// one change does not move everything behind it.
class PairSet {
 public:
  /// Toggles each key: one that is in goes out and vice versa. A key named twice stays. Sorts
  /// `keys`, whose halves are both below 2^bits.
  void toggle(std::vector<PairKey>& keys, int bits);
  /// `sorted`: strictly ascending; receives the previous content.
  void replace(std::vector<PairKey>& sorted);

  /// The set is `sorted`, corrected by `changed`: a key in `changed` is in the set exactly if it is
  /// not in `sorted`.
  const std::vector<PairKey>& sorted() const { return sorted_; }
  const std::vector<PairKey>& changed() const { return changed_; }
  std::size_t bytes() const;

 private:
  std::vector<PairKey> sorted_, changed_, scratch_;
};

}  // namespace swept::detail
