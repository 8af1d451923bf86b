// SPDX-License-Identifier: BSD-3-Clause
#include "broadphase/pair_set.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace swept::detail {
namespace {

constexpr int kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
/// Fewer are sorted by comparisons.
constexpr std::size_t kFewKeys = 300;

/// One stable pass by the digit that starts at bit `shift`.
void sortByDigit(const std::vector<PairKey>& from, int shift, std::vector<PairKey>& to) {
  std::array<std::uint32_t, kDigits> next{};
  const auto digit = [&](PairKey key) { return (key >> shift) & (kDigits - 1); };
  for (const PairKey key : from) ++next[digit(key)];
  std::uint32_t sum = 0;
  for (std::uint32_t& start : next) sum += std::exchange(start, sum);
  to.resize(from.size());
  for (const PairKey key : from) to[next[digit(key)]++] = key;
}

/// The elements of only one of two sorted lists.
void symmetricDifference(const std::vector<PairKey>& keys, const std::vector<PairKey>& changes,
                         std::vector<PairKey>& result) {
  result.clear();
  auto from = keys.begin();
  for (const PairKey change : changes) {
    const auto until = std::lower_bound(from, keys.end(), change);
    result.insert(result.end(), from, until);
    from = until;
    if (from != keys.end() && *from == change)
      ++from;
    else
      result.push_back(change);
  }
  result.insert(result.end(), from, keys.end());
}

/// Keeps one of each element that occurs an odd number of times.
void cancelTwins(std::vector<PairKey>& keys) {
  std::size_t kept = 0;
  for (const PairKey key : keys) {
    if (kept > 0 && keys[kept - 1] == key)
      --kept;
    else
      keys[kept++] = key;
  }
  keys.resize(kept);
}

}  // namespace

void sortPairs(std::vector<PairKey>& keys, int lowerBits, int upperBits,
               std::vector<PairKey>& scratch) {
  if (keys.size() < kFewKeys) {
    std::sort(keys.begin(), keys.end());
    return;
  }
  const auto sortHalf = [&](int first, int bits) {
    for (int bit = 0; bit < bits; bit += kDigitBits) {
      sortByDigit(keys, first + bit, scratch);
      keys.swap(scratch);
    }
  };
  sortHalf(0, lowerBits);
  sortHalf(32, upperBits);
}

void PairSet::toggle(std::vector<PairKey>& keys, int bits) {
  if (keys.empty()) return;
  sortPairs(keys, bits, bits, scratch_);
  cancelTwins(keys);
  symmetricDifference(changed_, keys, scratch_);
  changed_.swap(scratch_);
  // The root balances the work for the short list against that for the long one.
  const double few = 32.0 + 4.0 * std::sqrt(static_cast<double>(sorted_.size()));
  if (static_cast<double>(changed_.size()) <= few) return;
  symmetricDifference(sorted_, changed_, scratch_);
  sorted_.swap(scratch_);
  changed_.clear();
}

void PairSet::replace(std::vector<PairKey>& sorted) {
  sorted_.swap(sorted);
  changed_.clear();
}

std::size_t PairSet::bytes() const {
  return (sorted_.capacity() + changed_.capacity() + scratch_.capacity()) * sizeof(PairKey);
}

}  // namespace swept::detail
