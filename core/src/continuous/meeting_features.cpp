// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/meeting_features.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "continuous/meeting_features.cpp"  // compiled once for each instruction set
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

struct Vector {
  Lanes x, y, z;
};
HWY_INLINE Vector operator-(const Vector& a, const Vector& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vector operator+(const Vector& a, const Vector& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Lanes dot(const Vector& a, const Vector& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Vector cross(const Vector& a, const Vector& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}

/// Corners of up to eight pairs of triangles, at both ends.
struct alignas(64) PairCorners {
  TreeRow at[2][2][3][3];  ///< m, [end][triangle][corner][coordinate]
};

/// Differences of two features at both ends: those of a corner and the corners of a face, or of the
/// corners of two edges. The features are apart if some direction, the same at both ends, has all
/// differences beyond the margin: they move linearly.
template <int kCount>
struct Differences {
  Vector at[2][kCount];

  /// Along a direction of any length.
  HWY_INLINE Mask beyond(const Vector& n, Lanes margin) const {
    const Tag tag;
    Lanes least = dot(n, at[0][0]);
    Lanes most = least;
    for (int end = 0; end < 2; ++end) {
      for (int i = end == 0 ? 1 : 0; i < kCount; ++i) {
        const auto height = dot(n, at[end][i]);
        least = hn::Min(least, height);
        most = hn::Max(most, height);
      }
    }
    const auto extent = hn::Max(least, hn::Neg(most));
    const auto square = dot(n, n);
    // If the square of the length leaves single precision, nothing is proven.
    const auto usable =
        hn::And(hn::Gt(square, hn::Set(tag, 1e-30F)), hn::Lt(square, hn::Set(tag, 1e30F)));
    return hn::And(usable, hn::Gt(extent, hn::Mul(margin, hn::Sqrt(square))));
  }
  HWY_INLINE Mask beyondAxis(Lanes Vector::*axis, Lanes margin) const {
    Lanes least = at[0][0].*axis;
    Lanes most = least;
    for (int end = 0; end < 2; ++end) {
      for (int i = end == 0 ? 1 : 0; i < kCount; ++i) {
        least = hn::Min(least, at[end][i].*axis);
        most = hn::Max(most, at[end][i].*axis);
      }
    }
    return hn::Gt(hn::Max(least, hn::Neg(most)), margin);
  }
  HWY_INLINE Mask beyondAxes(Lanes margin) const {
    return hn::Or(hn::Or(beyondAxis(&Vector::x, margin), beyondAxis(&Vector::y, margin)),
                  beyondAxis(&Vector::z, margin));
  }
};

/// Eight pairs of triangles, or as many as there are lanes.
class PairFeatures {
 public:
  PairFeatures(const PairCorners& corners, std::size_t first, float margin)
      : margin_(hn::Set(Tag(), margin)) {
    for (int end = 0; end < 2; ++end) {
      for (int side = 0; side < 2; ++side) {
        for (int corner = 0; corner < 3; ++corner)
          at_[end][side][corner] = load(corners.at[end][side][corner], first);
      }
    }
    for (int side = 0; side < 2; ++side) {
      for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        edge_[side][k] =
            (at_[0][side][next] - at_[0][side][k]) + (at_[1][side][next] - at_[1][side][k]);
      }
      normal_[side] = cross(edge_[side][0], edge_[side][1]);
      const auto travel = [&](int k) { return at_[1][side][k] - at_[0][side][k]; };
      travel_[side] = travel(0) + travel(1) + travel(2);
    }
    const Vector relative = travel_[0] - travel_[1];
    for (int side = 0; side < 2; ++side) {
      for (int k = 0; k < 3; ++k) wake_[side][k] = cross(edge_[side][k], relative);
    }
  }

  HWY_INLINE Mask edgesApart(int i, int j) const {
    Differences<4> d;
    for (int end = 0; end < 2; ++end) {
      for (int k = 0; k < 4; ++k)
        d.at[end][k] = at_[end][0][(i + k % 2) % 3] - at_[end][1][(j + k / 2) % 3];
    }
    auto apart = d.beyondAxes(margin_);
    apart = hn::Or(apart, d.beyond(cross(edge_[0][i], edge_[1][j]), margin_));
    apart = hn::Or(apart, d.beyond(wake_[0][i], margin_));
    return hn::Or(apart, d.beyond(wake_[1][j], margin_));
  }

  /// A corner of one triangle from the other one.
  HWY_INLINE Mask cornerApart(int side, int corner) const {
    const int other = 1 - side;
    Differences<3> d;
    for (int end = 0; end < 2; ++end) {
      for (int k = 0; k < 3; ++k) d.at[end][k] = at_[end][side][corner] - at_[end][other][k];
    }
    auto apart = d.beyondAxes(margin_);
    apart = hn::Or(apart, d.beyond(normal_[other], margin_));
    for (int k = 0; k < 3; ++k) apart = hn::Or(apart, d.beyond(wake_[other][k], margin_));
    return apart;
  }

 private:
  static HWY_INLINE Vector load(const TreeRow (&rows)[3], std::size_t first) {
    const Tag tag;
    return {hn::Load(tag, rows[0].data() + first), hn::Load(tag, rows[1].data() + first),
            hn::Load(tag, rows[2].data() + first)};
  }

  Lanes margin_;
  Vector at_[2][2][3];  ///< [end][triangle][corner]
  Vector edge_[2][3];   ///< twice the edge halfway
  Vector normal_[2];
  Vector travel_[2];
  Vector wake_[2][3];  ///< normal of the plane that an edge sweeps, as seen from the other triangle
};

/// One copy in each file of kernels: code that is compiled once per instruction set has no header.
HWY_INLINE std::uint32_t bitsOf(Mask mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Tag(), mask, bits);
  return bits[0];
}

void gather(const MovingTree& tree, int side, std::uint32_t triangle, std::size_t lane,
            PairCorners& into) {
  const std::size_t block = triangle / kTreeLanes;
  const std::size_t from = triangle % kTreeLanes;
  for (int end = 0; end < 2; ++end) {
    const CornerBlock& corners = (end == 0 ? tree.start : tree.end)->corners[block];
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < 3; ++k) into.at[end][side][c][k][lane] = corners.at[c][k][from];
    }
  }
}

void spread(Mask apart, int bit, std::uint16_t* features, std::size_t count) {
  const std::uint32_t near = ~bitsOf(apart);
  for (std::size_t lane = 0; lane < count; ++lane)
    features[lane] = static_cast<std::uint16_t>(features[lane] | (near >> lane & 1U) << bit);
}

void FindMeetingFeatures(const MovingTree& a, const MovingTree& b, float margin,
                         const MeetingPair* pairs, std::size_t count, std::uint16_t* features) {
  PairCorners corners;
  for (std::size_t p = 0; p < count; p += kTreeLanes) {
    const std::size_t here = std::min<std::size_t>(kTreeLanes, count - p);
    for (std::size_t lane = 0; lane < kTreeLanes; ++lane) {
      const MeetingPair& pair = pairs[p + std::min(lane, here - 1)];
      gather(a, 0, pair.first, lane, corners);
      gather(b, 1, pair.second, lane, corners);
    }
    for (std::size_t first = 0; first < here; first += hn::Lanes(Tag())) {
      const PairFeatures group(corners, first, margin);
      std::uint16_t* out = features + p + first;
      const std::size_t lanes = std::min(here - first, hn::Lanes(Tag()));
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
          spread(group.edgesApart(i, j), FeatureBits::edges(i, j), out, lanes);
        spread(group.cornerApart(0, i), FeatureBits::firstCorner(i), out, lanes);
        spread(group.cornerApart(1, i), FeatureBits::secondCorner(i), out, lanes);
      }
    }
  }
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(FindMeetingFeatures);

void findMeetingFeatures(const MovingTree& a, const MovingTree& b, float margin,
                         std::span<const MeetingPair> pairs, std::vector<std::uint16_t>& features) {
  features.assign(pairs.size(), margin < kMostMargin ? 0 : FeatureBits::kAll);
  if (!(margin < kMostMargin)) return;
  SWEPT_DISPATCH(FindMeetingFeatures)
  (a, b, margin, pairs.data(), pairs.size(), features.data());
}

}  // namespace swept::detail
#endif
