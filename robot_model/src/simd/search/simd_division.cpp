// SPDX-License-Identifier: BSD-3-Clause
#include "simd/search/simd_division.hpp"

#include <algorithm>
#include <bit>

#include "simd/kernels/hull_planes.hpp"
#include "simd/kernels/simd_kinematics.hpp"

namespace swept::detail {

namespace {

/// Sub-intervals of one pair at most, and times at which exact geometry is asked about it.
constexpr std::size_t kMostParts = 64;
constexpr int kMostLooks = 6;
/// m per half-interval. Shorter ones the exact tier does as well.
constexpr float kFinestDivided = 2e-4F;

class Division {
 public:
  Division(SimdMotion& motion, ExactOracle& oracle, SimdGoal goal, SimdScratch& scratch,
           SimdAnswer& answer)
      : model_(motion.model()),
        motion_(motion),
        oracle_(oracle),
        scratch_(scratch),
        answer_(answer),
        decides_(goal == SimdGoal::Verdict) {}

  bool run() {
    sortByPair();
    auto& parts = scratch_.parts;
    std::size_t first = 0;
    while (first < parts.size()) {
      std::size_t last = first;
      while (last < parts.size() && parts[last].pair == parts[first].pair) ++last;
      scratch_.waiting.assign(parts.begin() + static_cast<std::ptrdiff_t>(first),
                              parts.begin() + static_cast<std::ptrdiff_t>(last));
      first = last;
      if (isSpent() || !canDivide(model_, scratch_.waiting.front().pair)) {
        for (const Part& part : scratch_.waiting) leave(part);
      } else if (dividePair()) {
        return true;
      }
    }
    return false;
  }

 private:
  using Part = SimdScratch::Part;

  bool isSpent() const { return answer_.intervals >= scratch_.mostIntervals; }

  void sortByPair() {
    auto& parts = scratch_.parts;
    parts.clear();
    for (const SimdScratch::Item& item : scratch_.rest)
      for (std::size_t i = item.first; i < item.first + item.count; ++i)
        parts.push_back({scratch_.restArena[i], item.time, item.half});
    std::ranges::sort(parts, [](const Part& a, const Part& b) {
      return a.pair != b.pair ? a.pair < b.pair : a.time < b.time;
    });
    scratch_.rest.clear();
    scratch_.restArena.clear();
  }

  bool dividePair() {
    looks_ = 0;
    beginSeen_ = endSeen_ = inContact_ = false;
    auto& waiting = scratch_.waiting;
    std::size_t done = 0;
    while (done < waiting.size()) {
      fillLanes(done);
      const std::size_t count = std::min<std::size_t>(kLanes, waiting.size() - done);
      place(done, count);
      std::uint32_t open = (1U << count) - 1;
      if (!inContact_ && examine(waiting[done].pair, open)) return true;
      for (; open != 0; open &= open - 1)
        handOn(waiting[done + static_cast<std::size_t>(std::countr_zero(open))]);
      done += count;
    }
    return false;
  }

  /// Halves those from `first` on until they fill the lanes: a look costs more than they do.
  void fillLanes(std::size_t first) {
    auto& waiting = scratch_.waiting;
    while (2 * (waiting.size() - first) <= kLanes && !isFine(waiting[first])) {
      const std::size_t last = waiting.size();
      for (std::size_t i = first; i < last; ++i) {
        const Part whole = waiting[i];
        waiting.push_back(half(whole, 1.0F));
        waiting[i] = half(whole, -1.0F);
      }
      std::ranges::sort(waiting.begin() + static_cast<std::ptrdiff_t>(first), waiting.end(), {},
                        &Part::time);
    }
  }

  static Part half(const Part& whole, float side) {
    const float half = 0.5F * whole.half;
    return {whole.pair, whole.time + side * half, half};
  }

  bool isFine(const Part& part) const {
    return 0.5F * part.half * part.half * answer_.acceleration < kFinestDivided;
  }

  void place(std::size_t first, std::size_t count) {
    SimdBlock& block = scratch_.block;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Part& part = scratch_.waiting[first + std::min(lane, count - 1)];
      block.time.lane[lane] = part.time;
      block.half.lane[lane] = part.half;
    }
    answer_.intervals += static_cast<int>(count);
    const SimdPairSource& source = model_.sources[scratch_.waiting[first].pair];
    placePair(source);
  }

  void placePair(const SimdPairSource& source) {
    const std::vector<int>& ofA = model_.ancestors[model_.geometryBody[source.geometry]];
    scratch_.bodies = ofA;
    if (source.obstacle < 0) {
      // Both begin with what they have in common.
      const std::vector<int>& ofB = model_.ancestors[model_.geometryBody[source.other]];
      scratch_.bodies.insert(scratch_.bodies.end(), std::ranges::mismatch(ofA, ofB).in2, ofB.end());
    }
    motion_.place(scratch_.bodies);
  }

  /// A time at which exact geometry is asked about the pair, and around it.
  struct Look {
    int lane;
    double t;
    double half;
  };

  /// The middle of what is open, but first the ends of the motion that it reaches: contacts that
  /// begin or end beyond the motion are deepest there.
  Look nextLook(std::uint32_t open) {
    const int first = std::countr_zero(open);
    const int last = std::bit_width(open) - 1;
    const bool atBegin = decides_ && !beginSeen_ && timeOf(first) - halfOf(first) <= 0.0;
    const bool atEnd = decides_ && !endSeen_ && timeOf(last) + halfOf(last) >= 1.0;
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

  /// True: a contact. Leaves in `open` what is not proven.
  bool examine(std::uint32_t pair, std::uint32_t& open) {
    while (open != 0 && looks_ < kMostLooks) {
      const Look at = nextLook(open);
      ++looks_;
      const ExactAnswer look = oracle_.look(pair, at.t, at.half);
      if (look.kind == ExactAnswer::Kind::Contact) {
        // Where the first contact is wanted, the exact tier looks for it.
        inContact_ = true;
        answer_.horizon = std::min(answer_.horizon, static_cast<float>(at.t));
        return decides_;
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

  /// In halves, or to the exact tier.
  void handOn(Part part) {
    const bool enough = scratch_.waiting.size() >= kMostParts || looks_ >= kMostLooks;
    if (enough || inContact_ || isSpent() || isFine(part)) {
      leave(part);
      return;
    }
    scratch_.waiting.push_back(half(part, -1.0F));
    scratch_.waiting.push_back(half(part, 1.0F));
  }

  void leave(const Part& part) {
    if (part.time - part.half >= answer_.horizon) return;
    scratch_.rest.push_back({part.time, part.half, scratch_.restArena.size(), 1});
    scratch_.restArena.push_back(part.pair);
  }

  const SimdModel& model_;
  SimdMotion& motion_;
  ExactOracle& oracle_;
  SimdScratch& scratch_;
  SimdAnswer& answer_;
  const bool decides_;  ///< a contact
  int looks_ = 0;
  bool beginSeen_ = false;  ///< of the pair
  bool endSeen_ = false;
  bool inContact_ = false;
};

}  // namespace

bool dividePairs(SimdMotion& motion, ExactOracle& oracle, SimdGoal goal, SimdScratch& scratch,
                 SimdAnswer& answer) {
  return Division(motion, oracle, goal, scratch, answer).run();
}

}  // namespace swept::detail
