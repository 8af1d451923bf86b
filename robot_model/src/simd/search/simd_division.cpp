// SPDX-License-Identifier: BSD-3-Clause
#include "simd/search/simd_division.hpp"

#include <algorithm>
#include <bit>

#include "simd/kernels/hull_planes.hpp"
#include "simd/kernels/simd_kinematics.hpp"

namespace swept::detail {

namespace {

/// Most sub-intervals of one pair, and most times at which exact geometry examines it.
constexpr std::size_t kMostParts = 64;
constexpr int kMostLooks = 6;
/// m. Inflation below which the exact tier does as well.
constexpr float kFinestDivided = 2e-4F;
/// Below it, middles may not be exact in single precision.
constexpr double kFinestHalf = 0x1p-20;

class Division {
 public:
  explicit Division(SimdSearch& search)
      : search_(search),
        model_(search.motion.model()),
        open_(search.work.open),
        waiting_(search.work.waiting),
        scratch_(search.scratch) {}

  bool run() {
    sortByPair();
    const std::vector<OpenPart>& parts = search_.work.parts;
    std::size_t first = 0;
    while (first < parts.size()) {
      std::size_t last = first;
      while (last < parts.size() && parts[last].pair == parts[first].pair) ++last;
      waiting_.assign(parts.begin() + static_cast<std::ptrdiff_t>(first),
                      parts.begin() + static_cast<std::ptrdiff_t>(last));
      first = last;
      if (search_.isSpent() || !canDivide(model_, waiting_.front().pair)) {
        for (const OpenPart& part : waiting_) leave(part);
      } else if (dividePair()) {
        return true;
      }
    }
    return false;
  }

 private:
  void sortByPair() {
    std::vector<OpenPart>& parts = search_.work.parts;
    parts.clear();
    for (const OpenInterval& interval : open_.intervals)
      for (const std::uint32_t pair : open_.pairsOf(interval))
        parts.push_back({pair, interval.begin, interval.end});
    std::ranges::sort(parts, [](const OpenPart& a, const OpenPart& b) {
      return a.pair != b.pair ? a.pair < b.pair : a.middle() < b.middle();
    });
    open_.clear();
  }

  bool dividePair() {
    looks_ = 0;
    beginSeen_ = endSeen_ = inContact_ = false;
    std::size_t done = 0;
    while (done < waiting_.size()) {
      fillLanes(done);
      const std::size_t count = std::min<std::size_t>(kLanes, waiting_.size() - done);
      place(done, count);
      std::uint32_t open = (1U << count) - 1;
      if (!inContact_ && examine(waiting_[done].pair, open)) return true;
      for (; open != 0; open &= open - 1)
        handOn(waiting_[done + static_cast<std::size_t>(std::countr_zero(open))]);
      done += count;
    }
    return false;
  }

  /// Halves the intervals from `first` on until they fill the lanes, because a look at exact
  /// geometry costs more than lanes do.
  void fillLanes(std::size_t first) {
    while (2 * (waiting_.size() - first) <= kLanes && !isFine(waiting_[first])) {
      const std::size_t last = waiting_.size();
      for (std::size_t i = first; i < last; ++i) {
        const OpenPart whole = waiting_[i];
        waiting_.push_back({whole.pair, whole.middle(), whole.end});
        waiting_[i].end = whole.middle();
      }
      std::ranges::sort(waiting_.begin() + static_cast<std::ptrdiff_t>(first), waiting_.end(), {},
                        &OpenPart::middle);
    }
  }

  bool isFine(const OpenPart& part) const {
    return part.half() < kFinestHalf ||
           search_.inflation(static_cast<float>(part.half())) < kFinestDivided;
  }

  void place(std::size_t first, std::size_t count) {
    SimdBlock& block = scratch_.block;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const OpenPart& part = waiting_[first + std::min(lane, count - 1)];
      block.time.lane[lane] = static_cast<float>(part.middle());
      block.half.lane[lane] = static_cast<float>(part.half());
    }
    search_.examined += static_cast<int>(count);
    placePair(model_.sources[waiting_[first].pair]);
  }

  void placePair(const SimdPairSource& source) {
    const std::vector<int>& ofA = model_.ancestors[model_.geometryBody[source.geometry]];
    scratch_.bodies = ofA;
    if (source.obstacle < 0) {
      // Both paths begin with their common ancestors.
      const std::vector<int>& ofB = model_.ancestors[model_.geometryBody[source.other]];
      scratch_.bodies.insert(scratch_.bodies.end(), std::ranges::mismatch(ofA, ofB).in2, ofB.end());
    }
    search_.motion.place(scratch_.bodies);
  }

  /// A time at which exact geometry examines the pair, and the interval around it.
  struct Look {
    int lane;
    double t;
    double half;
  };

  /// The middle of the open lanes. Before the first contact, the ends of the motion that they reach
  /// come first: a contact that begins or ends beyond the motion is deepest there.
  Look nextLook(std::uint32_t open) {
    const bool seeks = !search_.contacts.any();
    const int first = std::countr_zero(open);
    const int last = std::bit_width(open) - 1;
    const bool atBegin = seeks && !beginSeen_ && timeOf(first) - halfOf(first) <= 0.0;
    const bool atEnd = seeks && !endSeen_ && timeOf(last) + halfOf(last) >= 1.0;
    const bool onlyOne = atBegin != atEnd;
    if (atEnd && (onlyOne || looks_ > 0)) {
      endSeen_ = true;
      return {last, 1.0, 2.0 * halfOf(last)};
    }
    if (atBegin && (onlyOne || looks_ > 0)) {
      beginSeen_ = true;
      return {first, 0.0, 2.0 * halfOf(first)};
    }
    const int lane = middleOf(open);
    return {lane, timeOf(lane), halfOf(lane)};
  }

  /// True: a contact settles the search. Leaves in `open` what is not proven.
  bool examine(std::uint32_t pair, std::uint32_t& open) {
    if (search_.ofChange) open &= ~lanesOutward(model_, pair, open, scratch_);
    while (open != 0 && looks_ < kMostLooks) {
      const Look at = nextLook(open);
      ++looks_;
      const ExactAnswer look = search_.oracle.look(pair, at.t, at.half);
      if (look.kind == ExactAnswer::Kind::Contact) {
        // The exact tier looks for an earlier one, if that is wanted.
        inContact_ = true;
        return search_.contacts.settle();
      }
      std::uint32_t apart = look.kind == ExactAnswer::Kind::Apart ? 1U << at.lane : 0U;
      if (look.directed)
        apart |= lanesDivided(model_, pair,
                              {{look.towards[0], look.towards[1], look.towards[2]}, at.lane}, open,
                              scratch_);
      open &= ~apart;
      if (apart == 0) return false;
    }
    return false;
  }

  static int middleOf(std::uint32_t lanes) {
    for (int skip = std::popcount(lanes) / 2; skip > 0; --skip) lanes &= lanes - 1;
    return std::countr_zero(lanes);
  }

  double timeOf(int lane) const { return static_cast<double>(scratch_.block.time.lane[lane]); }
  double halfOf(int lane) const { return static_cast<double>(scratch_.block.half.lane[lane]); }

  /// Divides the part further, or leaves it to the exact tier.
  void handOn(OpenPart part) {
    const bool enough = waiting_.size() >= kMostParts || looks_ >= kMostLooks;
    if (enough || inContact_ || search_.isSpent() || isFine(part)) {
      leave(part);
      return;
    }
    const double middle = part.middle();
    waiting_.insert(waiting_.end(),
                    {{part.pair, part.begin, middle}, {part.pair, middle, part.end}});
  }

  void leave(const OpenPart& part) {
    if (part.begin >= search_.contacts.horizon()) return;
    open_.intervals.push_back({part.begin, part.end, open_.pairs.size(), 1});
    open_.pairs.push_back(part.pair);
  }

  SimdSearch& search_;
  const SimdModel& model_;
  OpenWork& open_;
  std::vector<OpenPart>& waiting_;
  SimdScratch& scratch_;
  int looks_ = 0;
  bool beginSeen_ = false;  ///< of the pair
  bool endSeen_ = false;
  bool inContact_ = false;
};

}  // namespace

bool dividePairs(SimdSearch& search) {
  return Division(search).run();
}

}  // namespace swept::detail
