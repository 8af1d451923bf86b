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

/// Sorts by the lowest bits of both halves, at least: so many of the lower and of the upper one.
void sortPairs(std::vector<PairKey>& keys, int lowerBits, int upperBits,
               std::vector<PairKey>& scratch);

/// Sorted pairs under changes. What changed lately is kept beside as a short sorted list, so that
/// one change does not move all that is behind it.
class PairSet {
 public:
  /// Each key that was in goes out and the other way round; one named twice stays. Sorts `keys`,
  /// both halves of which are below 2^bits.
  void toggle(std::vector<PairKey>& keys, int bits);
  /// `sorted`: strictly ascending; what it held before is given back in it.
  void replace(std::vector<PairKey>& sorted);

  /// The set is `sorted` but for `changed`, whose keys are in exactly if they are not in `sorted`.
  const std::vector<PairKey>& sorted() const { return sorted_; }
  const std::vector<PairKey>& changed() const { return changed_; }
  std::size_t bytes() const;

 private:
  std::vector<PairKey> sorted_, changed_, scratch_;
};

}  // namespace swept::detail
