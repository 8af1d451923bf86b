// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace swept::detail {

/// Pairs that may wait for shorter intervals, some 30 bytes each.
inline constexpr std::size_t kMostWaiting = std::size_t{1} << 24;

/// A part of a motion and the pairs that are not proven apart on it: a range of OpenWork::pairs.
/// Bisection of [0, 1] makes all intervals. So two of them are disjoint, or one contains the other,
/// and their ends are exact in either precision.
struct OpenInterval {
  double begin = 0.0;
  double end = 1.0;
  std::size_t first = 0;
  std::size_t count = 0;

  double middle() const { return 0.5 * (begin + end); }
  double half() const { return 0.5 * (end - begin); }
};

/// Open intervals. The halves of an interval may share its pairs.
struct OpenWork {
  std::vector<OpenInterval> intervals;
  std::vector<std::uint32_t> pairs;

  void clear() {
    intervals.clear();
    pairs.clear();
  }
  std::span<const std::uint32_t> pairsOf(const OpenInterval& interval) const {
    return std::span(pairs).subspan(interval.first, interval.count);
  }
  /// Adds both halves of an interval. Their pairs are those behind `first`; no pairs, no halves.
  void pushHalves(double begin, double end, std::size_t first) {
    const std::size_t count = pairs.size() - first;
    if (count == 0) return;
    const double middle = 0.5 * (begin + end);
    intervals.push_back({begin, middle, first, count});
    intervals.push_back({middle, end, first, count});
  }
};

/// One pair that is not proven apart on one interval.
struct OpenPart {
  std::uint32_t pair = 0;
  double begin = 0.0;
  double end = 1.0;

  double middle() const { return 0.5 * (begin + end); }
  double half() const { return 0.5 * (end - begin); }
};

/// The proof of one motion: what is open, and room for the tiers to work in.
struct ProofWork {
  /// All pairs are open on [0, 1], and `open` does not list them.
  bool everything = true;
  OpenWork open;
  /// The largest t known up to which nothing is open.
  double provenUntil = 0.0;

  OpenWork now, next;                     ///< the levels of a bisection
  std::vector<OpenPart> parts, waiting;   ///< pair by pair
  std::vector<std::uint32_t> unresolved;  ///< pairs of the interval that was examined last

  void begin() {
    everything = true;
    open.clear();
    provenUntil = 0.0;
  }
  bool isProven() const { return !everything && open.intervals.empty(); }
};

/// `now` becomes what is open, for a search of all of it: pairs with the same interval share its
/// kinematics.
void groupByInterval(ProofWork& work);

/// `now` becomes what is open, for a search in order of time: a stack of disjoint intervals, the
/// first on top. Once an interval is on top, nothing before its begin is open. It has the pairs of
/// all intervals in it. `parts` becomes what is open by pair and time, for sortOpenPairs().
void stackByTime(ProofWork& work);

struct OpenPairs {
  std::size_t onAll = 0;   ///< pairs that are open on all of an interval
  std::size_t onPart = 0;  ///< pairs that are open on a part of it only
};

/// Sorts the pairs of an interval of that stack: first those that are open on all of it, then those
/// that are open on a part. The others leave.
OpenPairs sortOpenPairs(const OpenInterval& interval, ProofWork& work);

}  // namespace swept::detail
