// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "narrowphase/point_box.hpp"
#include "narrowphase/point_cone.hpp"
#include "narrowphase/point_cylinder.hpp"
#include "narrowphase/point_point.hpp"
#include "narrowphase/point_segment.hpp"
#include "narrowphase/point_triangle.hpp"
#include "narrowphase/segment_segment.hpp"

namespace swept::detail {

/// A core with a closest point for any point makes a closed form with the point core, in either
/// order.
template <Convex::Core kind>
concept HasClosestPoint = requires(const Convex& body, const Eigen::Vector3d& p,
                                   ClosestPoint& closest) {
  closestPointOn(CoreTag<kind>{}, body, p, closest);
};

template <Convex::Core kind>
requires HasClosestPoint<kind>
[[gnu::always_inline]] inline bool closedForm(PointCore, CoreTag<kind> tag, const Convex& a,
                                              const Convex& b, const Eigen::Isometry3d& a_from_b,
                                              CoreGap& gap) {
  ClosestPoint closest;
  if (!closestPointOn(tag, b, originOfAInB(a_from_b), closest)) return false;
  gap = gapFromPoint(closest, a_from_b, pairRounding(a, b, a_from_b));
  return true;
}

template <Convex::Core kind>
requires HasClosestPoint<kind>
[[gnu::always_inline]] inline bool closedForm(CoreTag<kind> tag, PointCore, const Convex& a,
                                              const Convex& b, const Eigen::Isometry3d& a_from_b,
                                              CoreGap& gap) {
  ClosestPoint closest;
  if (!closestPointOn(tag, a, a_from_b.translation(), closest)) return false;
  gap = gapToPoint(closest, a_from_b, pairRounding(a, b, a_from_b));
  return true;
}

template <Convex::Core kindA, Convex::Core kindB>
concept HasClosedForm = requires(const Convex& body, const Eigen::Isometry3d& pose, CoreGap& gap) {
  closedForm(CoreTag<kindA>{}, CoreTag<kindB>{}, body, body, pose, gap);
};

}  // namespace swept::detail
