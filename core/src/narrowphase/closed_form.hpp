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

/// A core that has a foot for any point makes a closed form with the point, whichever comes first.
template <Convex::Core kind>
concept HasFoot = requires(const Convex& body, const Eigen::Vector3d& p, Foot& foot) {
  footOn(CoreTag<kind>{}, body, p, foot);
};

template <Convex::Core kind>
requires HasFoot<kind>
[[gnu::always_inline]] inline bool closedForm(PointCore, CoreTag<kind> tag, const Convex& a,
                                              const Convex& b, const Eigen::Isometry3d& a_from_b,
                                              CoreGap& gap) {
  Foot foot;
  if (!footOn(tag, b, originOfAInB(a_from_b), foot)) return false;
  gap = gapFromPoint(foot, a_from_b, pairRounding(a, b, a_from_b));
  return true;
}

template <Convex::Core kind>
requires HasFoot<kind>
[[gnu::always_inline]] inline bool closedForm(CoreTag<kind> tag, PointCore, const Convex& a,
                                              const Convex& b, const Eigen::Isometry3d& a_from_b,
                                              CoreGap& gap) {
  Foot foot;
  if (!footOn(tag, a, a_from_b.translation(), foot)) return false;
  gap = gapToPoint(foot, a_from_b, pairRounding(a, b, a_from_b));
  return true;
}

template <Convex::Core kindA, Convex::Core kindB>
concept HasClosedForm = requires(const Convex& body, const Eigen::Isometry3d& pose, CoreGap& gap) {
  closedForm(CoreTag<kindA>{}, CoreTag<kindB>{}, body, body, pose, gap);
};

}  // namespace swept::detail
