// SPDX-License-Identifier: BSD-3-Clause
#include "bvh/box_bounds.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/box_bounds.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, WideNode::kLanes>;
using Lanes = hn::Vec<Tag>;

/// m. Lemma: three squares of gaps, where they underflow, and their sum are too large by at most
/// 3 * 2^-150, and so is the root of the sum by 5e-23; gaps that are all less by e have a root that
/// is less by e or more. Sizes do not tell: two small parts of larger bodies may be this near.
constexpr double kUnderflow = 5e-23;

/// Data of the other box for one call, the same for all lanes.
struct Other {
  float center[3];   ///< m, in the first frame, from the node's origin
  float axes[3][3];  ///< [j]: axis j, in the first frame
  float half[3];     ///< m
  float rounding;    ///< m
};

HWY_INLINE Other prepare(const WideNode& node, const BoxFrames& frames, const OrientedBox& box) {
  Other other;
  const Eigen::Matrix3d& r = frames.linear;
  double size = node.reach;
  for (int i = 0; i < 3; ++i) {
    const double at = r(i, 0) * box.center[0] + r(i, 1) * box.center[1] + r(i, 2) * box.center[2] +
                      frames.translation[i] - node.origin[i];
    other.center[i] = static_cast<float>(at);
    other.half[i] = box.half[i];
    size += std::abs(at) + box.half[i];
    for (int j = 0; j < 3; ++j) {
      other.axes[j][i] = static_cast<float>(r(i, 0) * box.axes[j][0] + r(i, 1) * box.axes[j][1] +
                                            r(i, 2) * box.axes[j][2]);
    }
  }
  other.rounding = static_cast<float>(frames.rounding + frames.perMetre * size + kUnderflow);
  return other;
}

/// One box per lane, and the pose of the other box relative to it.
struct Boxes {
  Lanes half[3];
  Lanes offset[3];   ///< of the other's centre, in the first frame
  Lanes along[3];    ///< `offset` along the own axes
  Lanes turn[3][3];  ///< [i][j]: axis j of the other along the own axis i
  Lanes spread[3][3];
};

HWY_INLINE Lanes dot(const Lanes (&a)[3], const Lanes (&b)[3]) {
  return hn::MulAdd(a[0], b[0], hn::MulAdd(a[1], b[1], hn::Mul(a[2], b[2])));
}

HWY_INLINE Lanes loaded(const WideNode::Row& row, std::size_t at) {
  return hn::Load(Tag(), row.data() + at);
}

HWY_INLINE void place(const WideNode& node, std::size_t at, const Other& other, Boxes& boxes) {
  const Tag tag;
  for (int i = 0; i < 3; ++i) {
    boxes.half[i] = loaded(node.half[i], at);
    boxes.offset[i] = hn::Sub(hn::Set(tag, other.center[i]), loaded(node.center[i], at));
  }
  for (int i = 0; i < 3; ++i) {
    const Lanes axis[3] = {loaded(node.axes[i][0], at), loaded(node.axes[i][1], at),
                           loaded(node.axes[i][2], at)};
    boxes.along[i] = dot(axis, boxes.offset);
    for (int j = 0; j < 3; ++j) {
      const Lanes otherAxis[3] = {hn::Set(tag, other.axes[j][0]), hn::Set(tag, other.axes[j][1]),
                                  hn::Set(tag, other.axes[j][2])};
      boxes.turn[i][j] = dot(axis, otherAxis);
      boxes.spread[i][j] = hn::Abs(boxes.turn[i][j]);
    }
  }
}

/// The largest bound so far, and its direction, in the frame of the own axes.
struct Best {
  Lanes bound;
  Lanes along[3];
};

/// Gaps along the axes of one box.
struct FaceGaps {
  Lanes gap[3];
  Lanes positive[3];

  /// The distance that they prove together, or the largest gap if none is positive.
  HWY_INLINE Lanes together() {
    const auto zero = hn::Zero(Tag());
    for (int i = 0; i < 3; ++i) positive[i] = hn::Max(gap[i], zero);
    const auto largest = hn::Max(gap[0], hn::Max(gap[1], gap[2]));
    return hn::Max(largest, hn::Sqrt(dot(positive, positive)));
  }
};

/// The largest of the bounds of the six face axes.
template <bool directed>
HWY_INLINE void faceBounds(const Boxes& boxes, const Other& other, Best& best) {
  const Tag tag;
  const auto rounding = hn::Set(tag, other.rounding);
  const Lanes otherHalf[3] = {hn::Set(tag, other.half[0]), hn::Set(tag, other.half[1]),
                              hn::Set(tag, other.half[2])};
  FaceGaps own;
  for (int i = 0; i < 3; ++i) {
    const auto extents = hn::Add(hn::Add(boxes.half[i], rounding), dot(boxes.spread[i], otherHalf));
    own.gap[i] = hn::Sub(hn::Abs(boxes.along[i]), extents);
  }
  const auto bound = own.together();
  FaceGaps others;
  Lanes along[3];
  for (int j = 0; j < 3; ++j) {
    const Lanes axis[3] = {hn::Set(tag, other.axes[j][0]), hn::Set(tag, other.axes[j][1]),
                           hn::Set(tag, other.axes[j][2])};
    const Lanes spread[3] = {boxes.spread[0][j], boxes.spread[1][j], boxes.spread[2][j]};
    const auto extents = hn::Add(hn::Add(otherHalf[j], rounding), dot(spread, boxes.half));
    along[j] = dot(axis, boxes.offset);
    others.gap[j] = hn::Sub(hn::Abs(along[j]), extents);
  }
  const auto otherBound = others.together();
  best.bound = hn::Max(bound, otherBound);
  if constexpr (directed) {
    const auto ofOther = hn::Gt(otherBound, bound);
    for (int j = 0; j < 3; ++j) others.positive[j] = hn::CopySign(others.positive[j], along[j]);
    for (int i = 0; i < 3; ++i) {
      best.along[i] = hn::IfThenElse(ofOther, dot(boxes.turn[i], others.positive),
                                     hn::CopySign(own.positive[i], boxes.along[i]));
    }
  }
}

/// At most 1 / sqrt(x) up to its own rounding, however rough the approximation: Newton's
/// step x (3 - d x^2) / 2 approaches 1 / sqrt(d) from below, from either side.
HWY_INLINE Lanes reciprocalRoot(Lanes d) {
  const Tag tag;
  const auto rough = hn::ApproximateReciprocalSqrt(d);
  const auto halved = hn::Mul(hn::Set(tag, 0.5F), rough);
  return hn::Mul(halved, hn::NegMulAdd(hn::Mul(d, rough), rough, hn::Set(tag, 3.0F)));
}

/// The largest bound with the nine edge axes included. In the frame of the own axes, axis i x the
/// other's axis j has the components (next) -turn[last][j] and (last) turn[next][j].
template <bool directed>
HWY_INLINE void edgeBounds(const Boxes& boxes, const Other& other, Best& best) {
  const Tag tag;
  const auto rounding = hn::Set(tag, other.rounding);
  // More than 1: bound on how far the rounded square of a cosine may exceed the true one.
  const auto one = hn::Set(tag, 1.0F + 2e-6F);
  for (int i = 0; i < 3; ++i) {
    const int next = i == 2 ? 0 : i + 1;
    const int last = 3 - i - next;
    for (int j = 0; j < 3; ++j) {
      const int jNext = j == 2 ? 0 : j + 1;
      const int jLast = 3 - j - jNext;
      const auto along = hn::Abs(hn::NegMulAdd(boxes.along[next], boxes.turn[last][j],
                                               hn::Mul(boxes.along[last], boxes.turn[next][j])));
      const auto own = hn::MulAdd(boxes.half[next], boxes.spread[last][j],
                                  hn::MulAdd(boxes.half[last], boxes.spread[next][j], rounding));
      const auto extents =
          hn::MulAdd(hn::Set(tag, other.half[jNext]), boxes.spread[i][jLast],
                     hn::MulAdd(hn::Set(tag, other.half[jLast]), boxes.spread[i][jNext], own));
      const auto square = hn::NegMulAdd(boxes.turn[i][j], boxes.turn[i][j], one);
      const auto bound = hn::Mul(hn::Sub(along, extents), reciprocalRoot(square));
      if constexpr (directed) {
        const auto better = hn::Gt(bound, best.bound);
        best.along[i] = hn::IfThenZeroElse(better, best.along[i]);
        best.along[next] = hn::IfThenElse(better, hn::Neg(boxes.turn[last][j]), best.along[next]);
        best.along[last] = hn::IfThenElse(better, boxes.turn[next][j], best.along[last]);
      }
      best.bound = hn::Max(best.bound, bound);
    }
  }
}

/// `directions`: null, or receives the components.
template <bool directed>
HWY_INLINE void lowerBounds(const WideNode& node, const BoxFrames& frames, const OrientedBox& box,
                            float enough, float* lower, BoxDirections* directions) {
  const Tag tag;
  const Other other = prepare(node, frames, box);
  // The square roots, the sums of squares and the lengths of the axes are off by a few ulps.
  const auto shrink = hn::Set(tag, 1.0F - 2e-6F);
  for (std::size_t at = 0; at < WideNode::kLanes; at += hn::Lanes(tag)) {
    Boxes boxes;
    place(node, at, other, boxes);
    Best best;
    faceBounds<directed>(boxes, other, best);
    if (!hn::AllTrue(tag, hn::Gt(best.bound, hn::Set(tag, enough)))) {
      edgeBounds<directed>(boxes, other, best);
    }
    hn::StoreU(hn::Mul(best.bound, shrink), tag, lower + at);
    if constexpr (directed) {
      for (int i = 0; i < 3; ++i) {
        const Lanes component[3] = {loaded(node.axes[0][i], at), loaded(node.axes[1][i], at),
                                    loaded(node.axes[2][i], at)};
        hn::Store(dot(component, best.along), tag, directions->component[i].data() + at);
      }
    }
  }
}

void LowerBounds(const WideNode& node, const BoxFrames& frames, const OrientedBox& box,
                 float enough, float* lower) {
  lowerBounds<false>(node, frames, box, enough, lower, nullptr);
}

void DirectedBounds(const WideNode& node, const BoxFrames& frames, const OrientedBox& box,
                    float enough, float* lower, BoxDirections* directions) {
  lowerBounds<true>(node, frames, box, enough, lower, directions);
}

/// A ray misses a box if one of these separates them: an axis of the box that it starts beyond and
/// does not turn back on, or the cross product of an axis with its direction.
std::uint32_t Hit(const WideNode& node, const Eigen::Vector3d& origin,
                  const Eigen::Vector3d& direction) {
  const Tag tag;
  Other ray;
  double size = node.reach;
  for (int i = 0; i < 3; ++i) {
    const double at = origin[i] - node.origin[i];
    ray.center[i] = static_cast<float>(at);
    size += std::abs(at);
    ray.half[i] = 0.0F;
    for (int j = 0; j < 3; ++j) ray.axes[j][i] = static_cast<float>(direction[i]);
  }
  const double far = std::abs(origin[0]) + std::abs(origin[1]) + std::abs(origin[2]);
  const auto rounding = hn::Set(tag, static_cast<float>(kBoxRounding * size + 1e-14 * far));
  const auto turning = hn::Set(tag, static_cast<float>(kBoxRounding));
  std::uint32_t hits = 0;
  for (std::size_t at = 0; at < WideNode::kLanes; at += hn::Lanes(tag)) {
    Boxes boxes;
    place(node, at, ray, boxes);
    auto gap = hn::Set(tag, -1.0F);
    for (int i = 0; i < 3; ++i) {
      const int next = i == 2 ? 0 : i + 1;
      const int last = 3 - i - next;
      const auto outwards = hn::CopySign(hn::Set(tag, 1.0F), boxes.along[i]);
      const auto leaving = hn::Gt(hn::Mul(outwards, boxes.turn[i][0]), turning);
      const auto beyond = hn::Sub(hn::Abs(boxes.along[i]), hn::Add(boxes.half[i], rounding));
      gap = hn::Max(gap, hn::IfThenElseZero(leaving, beyond));
      const auto along = hn::Abs(hn::NegMulAdd(boxes.along[next], boxes.turn[last][0],
                                               hn::Mul(boxes.along[last], boxes.turn[next][0])));
      const auto extents =
          hn::MulAdd(boxes.half[next], boxes.spread[last][0],
                     hn::MulAdd(boxes.half[last], boxes.spread[next][0], rounding));
      gap = hn::Max(gap, hn::Sub(along, extents));
    }
    HWY_ALIGN float gaps[WideNode::kLanes];
    hn::Store(gap, tag, gaps);
    for (std::size_t lane = 0; lane < hn::Lanes(tag); ++lane) {
      if (!(gaps[lane] > 0.0F)) hits |= std::uint32_t{1} << (at + lane);
    }
  }
  return hits;
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(LowerBounds);
SWEPT_DISPATCH_TABLE(DirectedBounds);
SWEPT_DISPATCH_TABLE(Hit);

void boxLowerBounds(const WideNode& node, const BoxFrames& frames, const OrientedBox& other,
                    float enough, std::array<float, WideNode::kLanes>& lower) {
  SWEPT_DISPATCH(LowerBounds)(node, frames, other, enough, lower.data());
}

void boxLowerBounds(const WideNode& node, const BoxFrames& frames, const OrientedBox& other,
                    float enough, std::array<float, WideNode::kLanes>& lower,
                    BoxDirections& directions) {
  SWEPT_DISPATCH(DirectedBounds)(node, frames, other, enough, lower.data(), &directions);
}

std::uint32_t boxesHit(const WideNode& node, const Eigen::Vector3d& origin,
                       const Eigen::Vector3d& direction) {
  const std::uint32_t inUse = (std::uint32_t{1} << node.count) - 1;
  return SWEPT_DISPATCH(Hit)(node, origin, direction) & inUse;
}

}  // namespace swept::detail
#endif
