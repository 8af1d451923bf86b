// SPDX-License-Identifier: BSD-3-Clause
#include "simd/kernels/link_points.hpp"

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/kernels/link_points.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/kernels/f8.hpp"
#include "simd/kernels/obstacle_kernels.hpp"
#include "simd/kernels/placed_ball.hpp"
#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

PointsInside Points(const SimdModel& model, const LikelyContact& likelyContact,
                    SimdScratch& scratch) {
  PointsInside inside;
  const SimdPairSource& source = model.sources[likelyContact.pair];
  const SimdObstacle& obstacle = model.obstacles.obstacles[source.obstacle];
  const SimdHull& hull = model.hulls->of[source.geometry];
  const bool sure = obstacle.near == NearProof::Inside || obstacle.near == NearProof::Distance;
  if (!sure || !hull.ofGeometry) return inside;
  const SimdBodyState& state = scratch.block.states[model.geometryBody[source.geometry]];
  for (std::int32_t i = hull.first; kLanes * (i - hull.first) < hull.count; ++i) {
    const V3 x = placedAt(state, likelyContact.lane, model.hulls->points[i]);
    const F8 away = squaredDistance(model.obstacles, obstacle, x);
    const Lanes found = below(away, set(1e-30F));
    if (found == 0) continue;
    for (Lanes left = found; left != 0; left &= left - 1)
      inside.index[inside.count++] = kLanes * i + std::countr_zero(left);
    return inside;
  }
  return inside;
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(Points);

PointsInside pointsInside(const SimdModel& model, const LikelyContact& likelyContact,
                          SimdScratch& scratch) {
  return SWEPT_DISPATCH(Points)(model, likelyContact, scratch);
}

}  // namespace swept::detail
#endif
