// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/follow_corners.hpp"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "continuous/follow_corners.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, kTreeLanes>;
using Lanes = hn::Vec<Tag>;

double LargestCoordinate(const double* values, std::size_t count) {
  const hn::ScalableTag<double> tag;
  const std::size_t step = hn::Lanes(tag);
  auto largest = hn::Zero(tag);
  // A non-finite value makes this NaN for good.
  auto nothing = hn::Zero(tag);
  std::size_t i = 0;
  for (; i + step <= count; i += step) {
    const auto x = hn::LoadU(tag, values + i);
    largest = hn::Max(largest, hn::Abs(x));
    nothing = hn::MulAdd(x, hn::Zero(tag), nothing);
  }
  double most = hn::GetLane(hn::MaxOfLanes(tag, largest));
  double sum = hn::GetLane(hn::SumOfLanes(tag, nothing));
  for (; i < count; ++i) {
    const double magnitude = values[i] < 0.0 ? -values[i] : values[i];
    most = magnitude > most ? magnitude : most;
    sum += values[i] * 0.0;
  }
  return most + sum;
}

/// The box around eight boxes.
struct Around {
  Lanes lower[3], upper[3];

  HWY_INLINE Around() {
    for (int k = 0; k < 3; ++k) {
      lower[k] = hn::Set(Tag(), std::numeric_limits<float>::infinity());
      upper[k] = hn::Set(Tag(), -std::numeric_limits<float>::infinity());
    }
  }
  HWY_INLINE void add(const Lanes (&low)[3], const Lanes (&high)[3]) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = hn::Min(lower[k], low[k]);
      upper[k] = hn::Max(upper[k], high[k]);
    }
  }
  HWY_INLINE void store(BoxBlock& into, std::size_t lane) const {
    const Tag tag;
    for (int k = 0; k < 3; ++k) {
      into.lower[k][lane] = hn::GetLane(hn::MinOfLanes(tag, lower[k]));
      into.upper[k][lane] = hn::GetLane(hn::MaxOfLanes(tag, upper[k]));
    }
  }
};

HWY_INLINE Lanes halfArea(const Lanes (&low)[3], const Lanes (&high)[3]) {
  const auto x = hn::Sub(high[0], low[0]);
  const auto y = hn::Sub(high[1], low[1]);
  const auto z = hn::Sub(high[2], low[2]);
  return hn::MulAdd(x, hn::Add(y, z), hn::Mul(y, z));
}

HWY_INLINE void transpose(const VertexBlock& vertices, const FloatPoint* points,
                          CornerBlock& block) {
  const Tag tag;
  alignas(64) FloatPoint gathered[kTreeLanes];
  for (int corner = 0; corner < 3; ++corner) {
    const auto c = static_cast<std::size_t>(corner);
    for (std::size_t lane = 0; lane < kTreeLanes; ++lane)
      gathered[lane] = points[vertices.of[c][lane]];
    for (std::size_t first = 0; first < kTreeLanes; first += hn::Lanes(tag)) {
      Lanes x, y, z, unused;
      hn::LoadInterleaved4(tag, &gathered[first].x, x, y, z, unused);
      hn::Store(x, tag, block.at[c][0].data() + first);
      hn::Store(y, tag, block.at[c][1].data() + first);
      hn::Store(z, tag, block.at[c][2].data() + first);
    }
  }
}

/// Stores the box around eight triangles, and returns the area of their own boxes.
HWY_INLINE Lanes boundCorners(const CornerBlock& block, BoxBlock& into, std::size_t lane) {
  const Tag tag;
  Around around;
  auto area = hn::Zero(tag);
  for (std::size_t first = 0; first < kTreeLanes; first += hn::Lanes(tag)) {
    Lanes low[3], high[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = hn::Load(tag, block.at[0][k].data() + first);
      const auto b = hn::Load(tag, block.at[1][k].data() + first);
      const auto c = hn::Load(tag, block.at[2][k].data() + first);
      low[k] = hn::Min(hn::Min(a, b), c);
      high[k] = hn::Max(hn::Max(a, b), c);
    }
    area = hn::Add(area, halfArea(low, high));
    around.add(low, high);
  }
  around.store(into, lane);
  return area;
}

HWY_INLINE Lanes boundBoxes(const BoxBlock& block, BoxBlock& into, std::size_t lane) {
  const Tag tag;
  Around around;
  auto area = hn::Zero(tag);
  for (std::size_t first = 0; first < kTreeLanes; first += hn::Lanes(tag)) {
    Lanes low[3], high[3];
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = hn::Load(tag, block.lower[k].data() + first);
      high[k] = hn::Load(tag, block.upper[k].data() + first);
    }
    area = hn::Add(area, halfArea(low, high));
    around.add(low, high);
  }
  around.store(into, lane);
  return area;
}

void repeatLast(BoxBlock& block, std::size_t used) {
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t lane = used; lane < kTreeLanes; ++lane) {
      block.lower[k][lane] = block.lower[k][used - 1];
      block.upper[k][lane] = block.upper[k][used - 1];
    }
  }
}

// Partial sums of few terms each: single precision is enough for those.
double total(Lanes sum) {
  return static_cast<double>(hn::GetLane(hn::SumOfLanes(Tag(), sum)));
}

/// Bounds blocks of a level above 0 in the level above it, and returns the area of their boxes.
double boundLevel(const TreeOrder& order, int level, std::size_t first, std::size_t last,
                  DeformingFrame& frame) {
  const auto l = static_cast<std::size_t>(level);
  std::vector<BoxBlock>& boxes = frame.boxes[l];
  if (last == boxes.size()) repeatLast(boxes.back(), (order.below(level) - 1) % kTreeLanes + 1);
  double area = 0.0;
  if (level + 1 == order.levels) return area;
  for (std::size_t b = first; b < last; ++b)
    area += total(boundBoxes(boxes[b], frame.boxes[l + 1][b / kTreeLanes], b % kTreeLanes));
  return area;
}

BoxAreas FollowSubtree(const TreeOrder& order, const FloatPoint* points, std::size_t subtree,
                       DeformingFrame& frame) {
  const int top = subtreeLevel(order);
  std::size_t each = 1;
  for (int level = 0; level < top; ++level) each *= kTreeLanes;
  BoxAreas areas;
  for (int level = 0; level <= top; ++level, each /= kTreeLanes) {
    const std::size_t first = subtree * each;
    const std::size_t last = std::min(first + each, order.blocks[static_cast<std::size_t>(level)]);
    if (level > 0) {
      areas.nodes += boundLevel(order, level, first, last, frame);
      continue;
    }
    for (std::size_t b = first; b < last; ++b) {
      transpose(order.vertices[b], points, frame.corners[b]);
      areas.triangles +=
          total(boundCorners(frame.corners[b], frame.boxes[1][b / kTreeLanes], b % kTreeLanes));
    }
  }
  return areas;
}

double FollowTop(const TreeOrder& order, DeformingFrame& frame) {
  double area = 0.0;
  for (int level = subtreeLevel(order) + 1; level < order.levels; ++level)
    area += boundLevel(order, level, 0, order.blocks[static_cast<std::size_t>(level)], frame);
  return area;
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(LargestCoordinate);
SWEPT_DISPATCH_TABLE(FollowSubtree);
SWEPT_DISPATCH_TABLE(FollowTop);

double largestCoordinate(std::span<const Eigen::Vector3d> points) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  if (points.empty()) return 0.0;
  return SWEPT_DISPATCH(LargestCoordinate)(points.front().data(), 3 * points.size());
}

BoxAreas followSubtree(const TreeOrder& order, std::span<const FloatPoint> points,
                       std::size_t subtree, DeformingFrame& frame) {
  return SWEPT_DISPATCH(FollowSubtree)(order, points.data(), subtree, frame);
}

double followTop(const TreeOrder& order, DeformingFrame& frame) {
  return SWEPT_DISPATCH(FollowTop)(order, frame);
}

}  // namespace swept::detail
#endif
