// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/meeting_pairs.hpp"

#include <algorithm>
#include <array>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "continuous/meeting_pairs.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, kTreeLanes>;
using Lanes = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;
using IntTag = hn::CappedTag<std::int32_t, kTreeLanes>;

/// One copy in each file of kernels: code that is compiled once per instruction set has no header.
HWY_INLINE std::uint32_t bitsOf(Mask mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Tag(), mask, bits);
  return bits[0];
}

/// A box grown by the margin, for comparison with those of lanes.
struct GrownBox {
  float lower[3], upper[3];

  HWY_INLINE void set(const BoxBlock& block, std::size_t lane, float margin) {
    for (std::size_t k = 0; k < 3; ++k) {
      lower[k] = block.lower[k][lane] - margin;
      upper[k] = block.upper[k][lane] + margin;
    }
  }
};

/// At either end of the motion.
using Blocks = std::array<const BoxBlock*, 2>;

/// Bit i: no axis separates box i, on its way from one end to the other, from the grown box. Boxes
/// around the corners at both ends, moving linearly, contain the triangle at every time between,
/// and the gap along an axis is linear too. A NaN separates nothing.
template <int kEnds>
HWY_INLINE std::uint32_t lanesMeet(const Blocks& blocks, const GrownBox (&box)[2]) {
  const Tag tag;
  std::uint32_t meet = 0;
  for (std::size_t first = 0; first < kTreeLanes; first += hn::Lanes(tag)) {
    const auto above = [&](int end, std::size_t k) {
      return hn::Gt(hn::Load(tag, blocks[end]->lower[k].data() + first),
                    hn::Set(tag, box[end].upper[k]));
    };
    const auto below = [&](int end, std::size_t k) {
      return hn::Lt(hn::Load(tag, blocks[end]->upper[k].data() + first),
                    hn::Set(tag, box[end].lower[k]));
    };
    const auto apart = [&](std::size_t k) {
      if constexpr (kEnds == 1) return hn::Or(above(1, k), below(1, k));
      return hn::Or(hn::And(above(0, k), above(1, k)), hn::And(below(0, k), below(1, k)));
    };
    meet |= bitsOf(hn::Not(hn::Or(hn::Or(apart(0), apart(1)), apart(2)))) << first;
  }
  return meet;
}

/// Data of eight triangles that is used again and again.
struct Prepared {
  const CornerBlock* corners[2];
  BoxBlock box[2];
  TreeRow normal[3];  ///< unit, or unusable, of the triangle halfway
  std::uint32_t block = ~0U;
};

template <int kEnds>
HWY_INLINE void prepareBoxes(Prepared& p) {
  const Tag tag;
  for (int end = 2 - kEnds; end < 2; ++end) {
    for (std::size_t first = 0; first < kTreeLanes; first += hn::Lanes(tag)) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = hn::Load(tag, p.corners[end]->at[0][k].data() + first);
        const auto b = hn::Load(tag, p.corners[end]->at[1][k].data() + first);
        const auto c = hn::Load(tag, p.corners[end]->at[2][k].data() + first);
        hn::Store(hn::Min(hn::Min(a, b), c), tag, p.box[end].lower[k].data() + first);
        hn::Store(hn::Max(hn::Max(a, b), c), tag, p.box[end].upper[k].data() + first);
      }
    }
  }
}

/// Scales to unit length. Vectors too short for a square in single precision become zero, which
/// proves nothing.
HWY_INLINE void normalize(Lanes (&n)[3]) {
  const Tag tag;
  const auto square = hn::MulAdd(n[0], n[0], hn::MulAdd(n[1], n[1], hn::Mul(n[2], n[2])));
  const auto usable =
      hn::And(hn::Gt(square, hn::Set(tag, 1e-30F)), hn::Lt(square, hn::Set(tag, 1e30F)));
  const auto scale = hn::IfThenElseZero(usable, hn::Div(hn::Set(tag, 1.0F), hn::Sqrt(square)));
  for (auto& x : n) x = hn::IfThenElseZero(usable, hn::Mul(x, scale));
}

template <int kEnds>
HWY_INLINE void prepareNormals(Prepared& p) {
  const Tag tag;
  for (std::size_t first = 0; first < kTreeLanes; first += hn::Lanes(tag)) {
    const auto corner = [&](std::size_t c, std::size_t k) {
      const auto end = hn::Load(tag, p.corners[1]->at[c][k].data() + first);
      if constexpr (kEnds == 1) return end;
      return hn::Add(end, hn::Load(tag, p.corners[0]->at[c][k].data() + first));
    };
    Lanes u[3], v[3];
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = hn::Sub(corner(1, k), corner(0, k));
      v[k] = hn::Sub(corner(2, k), corner(0, k));
    }
    Lanes n[3];
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      n[k] = hn::MulSub(u[i], v[j], hn::Mul(u[j], v[i]));
    }
    const auto largest = hn::Max(hn::Max(hn::Abs(n[0]), hn::Abs(n[1])), hn::Abs(n[2]));
    const auto scale = hn::Div(hn::Set(tag, 1.0F), largest);
    for (auto& x : n) x = hn::Mul(x, scale);
    normalize(n);
    for (int k = 0; k < 3; ++k) hn::Store(n[k], tag, p.normal[k].data() + first);
  }
}

/// One triangle of a block against eight of another.
template <int kEnds>
struct TriangleAgainst {
  const Prepared& a;
  std::size_t lane;
  const Prepared& b;
  std::size_t first;  ///< first lane of b in the vectors
  float margin;

  HWY_INLINE Lanes cornerA(int end, std::size_t c, std::size_t k) const {
    return hn::Set(Tag(), a.corners[end]->at[c][k][lane]);
  }
  HWY_INLINE Lanes cornerB(int end, std::size_t c, std::size_t k) const {
    return hn::Load(Tag(), b.corners[end]->at[c][k].data() + first);
  }

  /// Whether all corners of the one are beyond those of the other along n, at both ends.
  HWY_INLINE Mask apartAlong(const Lanes (&n)[3]) const {
    const Tag tag;
    const auto least = hn::Set(tag, margin);
    Lanes gap[2], opposite[2];
    for (int end = 2 - kEnds; end < 2; ++end) {
      const auto heightA = [&](std::size_t c) {
        return hn::MulAdd(n[0], cornerA(end, c, 0),
                          hn::MulAdd(n[1], cornerA(end, c, 1), hn::Mul(n[2], cornerA(end, c, 2))));
      };
      const auto heightB = [&](std::size_t c) {
        return hn::MulAdd(n[0], cornerB(end, c, 0),
                          hn::MulAdd(n[1], cornerB(end, c, 1), hn::Mul(n[2], cornerB(end, c, 2))));
      };
      const auto a0 = heightA(0), a1 = heightA(1), a2 = heightA(2);
      const auto b0 = heightB(0), b1 = heightB(1), b2 = heightB(2);
      gap[end] = hn::Sub(hn::Min(hn::Min(b0, b1), b2), hn::Max(hn::Max(a0, a1), a2));
      opposite[end] = hn::Sub(hn::Min(hn::Min(a0, a1), a2), hn::Max(hn::Max(b0, b1), b2));
    }
    if constexpr (kEnds == 1) return hn::Or(hn::Gt(gap[1], least), hn::Gt(opposite[1], least));
    return hn::Or(hn::And(hn::Gt(gap[0], least), hn::Gt(gap[1], least)),
                  hn::And(hn::Gt(opposite[0], least), hn::Gt(opposite[1], least)));
  }

  HWY_INLINE Mask apart() const {
    const Tag tag;
    Lanes n[3];
    for (std::size_t k = 0; k < 3; ++k) n[k] = hn::Set(tag, a.normal[k][lane]);
    auto found = apartAlong(n);
    for (std::size_t k = 0; k < 3; ++k) n[k] = hn::Load(tag, b.normal[k].data() + first);
    found = hn::Or(found, apartAlong(n));
    return found;
  }
};

/// Bit i: triangle i of the vertices has a vertex of triangle `lane` of the others.
HWY_INLINE std::uint32_t sharing(const VertexBlock& others, std::size_t lane,
                                 const VertexBlock& vertices) {
  const IntTag tag;
  std::uint32_t shared = 0;
  for (std::size_t first = 0; first < kTreeLanes; first += hn::Lanes(tag)) {
    const auto has = [&](std::size_t i, std::size_t j) {
      return hn::Eq(hn::Load(tag, vertices.of[j].data() + first), hn::Set(tag, others.of[i][lane]));
    };
    const auto hasAny = [&](std::size_t i) {
      return hn::Or(hn::Or(has(i, 0), has(i, 1)), has(i, 2));
    };
    const auto any = hn::Or(hn::Or(hasAny(0), hasAny(1)), hasAny(2));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, any, bits);
    shared |= std::uint32_t{bits[0]} << first;
  }
  return shared;
}

template <int kEnds>
class Finder {
 public:
  Finder(const MovingTree& a, const MovingTree& b, bool same, float margin,
         std::vector<OpenBlocks>& open, std::vector<MeetingPair>& pairs)
      : a_(a),
        b_(b),
        same_(same),
        margin_(margin),
        filtered_(margin < kMostMargin),
        open_(open),
        pairs_(pairs) {}

  void run() {
    const auto top = [](const MovingTree& tree) {
      return static_cast<std::uint8_t>(tree.order->levels - 2);
    };
    open_.clear();
    open_.push_back({0, 0, top(a_), top(b_)});
    while (!open_.empty()) {
      const OpenBlocks pair = open_.back();
      open_.pop_back();
      if (pair.firstLevel == 0 && pair.secondLevel == 0) {
        lookAtTriangles(pair.first, pair.second);
      } else if (pair.firstLevel == pair.secondLevel) {
        descendBoth(pair);
      } else {
        descendOne(pair, pair.firstLevel > pair.secondLevel);
      }
    }
  }

 private:
  static Blocks boxes(const MovingTree& tree, int level, std::uint32_t block) {
    const auto l = static_cast<std::size_t>(level);
    return {kEnds == 1 ? nullptr : &tree.start->boxes[l][block], &tree.end->boxes[l][block]};
  }
  void grow(const Blocks& blocks, std::size_t lane, GrownBox (&box)[2]) const {
    for (int end = 2 - kEnds; end < 2; ++end) box[end].set(*blocks[end], lane, margin_);
  }
  /// Lanes of a block that hold something.
  static std::uint32_t inUse(const MovingTree& tree, int level, std::uint32_t block) {
    const std::size_t count = tree.order->below(level) - std::size_t{block} * kTreeLanes;
    return count >= kTreeLanes ? 0xFFU : (1U << count) - 1U;
  }

  void descendBoth(const OpenBlocks& pair) {
    const int level = pair.firstLevel;
    const auto below = static_cast<std::uint8_t>(level - 1);
    const Blocks first = boxes(a_, level, pair.first);
    const Blocks second = boxes(b_, level, pair.second);
    const std::uint32_t used = inUse(b_, level, pair.second);
    const bool itself = same_ && pair.first == pair.second;
    std::uint32_t lanes = inUse(a_, level, pair.first);
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(lanes));
      GrownBox box[2];
      grow(first, i, box);
      std::uint32_t hits = lanesMeet<kEnds>(second, box) & used;
      if (itself) hits = (hits & (0xFEU << i)) | 1U << i;
      for (; hits != 0; hits &= hits - 1) {
        const auto j = static_cast<std::uint32_t>(std::countr_zero(hits));
        open_.push_back({pair.first * kTreeLanes + i, pair.second * kTreeLanes + j, below, below});
      }
    }
  }

  void descendOne(const OpenBlocks& pair, bool descendFirst) {
    const MovingTree& tall = descendFirst ? a_ : b_;
    const MovingTree& low = descendFirst ? b_ : a_;
    const std::uint32_t tallBlock = descendFirst ? pair.first : pair.second;
    const std::uint32_t lowBlock = descendFirst ? pair.second : pair.first;
    const int level = std::max(pair.firstLevel, pair.secondLevel);
    const int lowLevel = std::min(pair.firstLevel, pair.secondLevel);
    const Blocks from = boxes(tall, level, tallBlock);
    const Blocks around = boxes(low, lowLevel + 1, lowBlock / kTreeLanes);
    GrownBox box[2];
    grow(around, lowBlock % kTreeLanes, box);
    std::uint32_t hits = lanesMeet<kEnds>(from, box) & inUse(tall, level, tallBlock);
    for (; hits != 0; hits &= hits - 1) {
      const std::uint32_t child =
          tallBlock * kTreeLanes + static_cast<std::uint32_t>(std::countr_zero(hits));
      OpenBlocks next = pair;
      (descendFirst ? next.first : next.second) = child;
      (descendFirst ? next.firstLevel : next.secondLevel) = static_cast<std::uint8_t>(level - 1);
      open_.push_back(next);
    }
  }

  static void prepare(const MovingTree& tree, std::uint32_t block, Prepared& p) {
    p.corners[0] = kEnds == 1 ? nullptr : &tree.start->corners[block];
    p.corners[1] = &tree.end->corners[block];
    p.block = block;
    prepareBoxes<kEnds>(p);
  }

  void lookAtTriangles(std::uint32_t first, std::uint32_t second) {
    if (preparedA_.block != first) {
      prepare(a_, first, preparedA_);
      prepareNormals<kEnds>(preparedA_);
    }
    Prepared preparedB;
    prepare(b_, second, preparedB);
    bool withNormals = false;
    const Blocks around = boxes(b_, 1, second / kTreeLanes);
    GrownBox whole[2];
    grow(around, second % kTreeLanes, whole);
    const Blocks boxesA = {&preparedA_.box[0], &preparedA_.box[1]};
    const Blocks boxesB = {&preparedB.box[0], &preparedB.box[1]};
    const std::uint32_t used = inUse(b_, 0, second);
    std::uint32_t lanes = lanesMeet<kEnds>(boxesA, whole) & inUse(a_, 0, first);
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(lanes));
      GrownBox box[2];
      grow(boxesA, i, box);
      std::uint32_t hits = lanesMeet<kEnds>(boxesB, box) & used;
      if (same_) hits = withoutNeighbours(first, i, second, hits);
      if (hits == 0) continue;
      if (!filtered_) {
        append(first, i, second, hits);
        continue;
      }
      if (!withNormals) prepareNormals<kEnds>(preparedB);
      withNormals = true;
      hits &= ~keptApart(preparedA_, i, preparedB);
      append(first, i, second, hits);
    }
  }

  HWY_INLINE std::uint32_t keptApart(const Prepared& a, std::size_t lane, const Prepared& b) const {
    std::uint32_t apart = 0;
    for (std::size_t f = 0; f < kTreeLanes; f += hn::Lanes(Tag()))
      apart |= bitsOf(TriangleAgainst<kEnds>{a, lane, b, f, margin_}.apart()) << f;
    return apart;
  }

  std::uint32_t withoutNeighbours(std::uint32_t first, std::uint32_t lane, std::uint32_t second,
                                  std::uint32_t hits) {
    if (first == second) hits &= 0xFEU << lane;
    if (hits == 0) return 0;
    const TreeOrder& order = *a_.order;
    const std::uint32_t shared =
        hits & sharing(order.vertices[first], lane, order.vertices[second]);
    if (kEnds == 2 && shared != 0 && (order.marked[first] >> lane & 1U) != 0)
      append(first, lane, second, shared & order.marked[second]);
    return hits & ~shared;
  }

  void append(std::uint32_t first, std::uint32_t lane, std::uint32_t second, std::uint32_t hits) {
    for (; hits != 0; hits &= hits - 1) {
      const auto j = static_cast<std::uint32_t>(std::countr_zero(hits));
      pairs_.push_back({first * kTreeLanes + lane, second * kTreeLanes + j});
    }
  }

  const MovingTree& a_;
  const MovingTree& b_;
  bool same_;
  float margin_;
  bool filtered_;
  std::vector<OpenBlocks>& open_;
  std::vector<MeetingPair>& pairs_;
  Prepared preparedA_;
};

void FindMeetingPairs(const MovingTree& a, const MovingTree& b, bool same, float margin,
                      std::vector<OpenBlocks>& open, std::vector<MeetingPair>& pairs) {
  if (a.start == nullptr || b.start == nullptr) {
    Finder<1>(a, b, same, margin, open, pairs).run();
  } else {
    Finder<2>(a, b, same, margin, open, pairs).run();
  }
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(FindMeetingPairs);

void findMeetingPairs(const MovingTree& a, const MovingTree& b, bool same, float margin,
                      std::vector<OpenBlocks>& open, std::vector<MeetingPair>& pairs) {
  SWEPT_DISPATCH(FindMeetingPairs)(a, b, same, margin, open, pairs);
}

}  // namespace swept::detail
#endif
