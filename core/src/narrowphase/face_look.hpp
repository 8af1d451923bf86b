// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <utility>

#include "narrowphase/face_probe.hpp"

namespace swept::detail {

/// The flat faces of either body that face the other one.
struct Look {
  double separation = -std::numeric_limits<double>::infinity();  ///< m, proven but for rounding
  Eigen::Vector3d normal =
      Eigen::Vector3d::Zero();  ///< of the face that separates most, from a to b
  bool inside = false;          ///< `gap.common` is in both cores
  bool exact = false;           ///< `gap` is the answer
  CoreGap gap;
};

/// Over a face, the point nearest to its plane is nearest to the body.
inline void note(const FaceProbe& found, Look& look) {
  if (found.separation > look.separation) {
    look.separation = found.separation;
    look.normal = found.normal;
    look.exact = found.over && found.separation > 0.0;
    if (look.exact) {
      look.gap.distance = found.separation;
      look.gap.normal = found.normal;
      look.gap.pointA = found.lowest - found.separation * found.normal;
      look.gap.pointB = found.lowest;
    }
  }
}

template <Convex::Core kindA, Convex::Core kindB>
Look look(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b) {
  Look look;
  look.gap.rounding = pairRounding(a, b, a_from_b);
  if constexpr (probe::kHasFaces<kindA>) {
    const FaceProbe found =
        probeFaces(CoreTag<kindA>{}, a, b, a_from_b.linear(), a_from_b.translation());
    if (found.inside) {
      look.inside = true;
      look.gap.distance = 0.0;
      look.gap.normal = found.normal;
      look.gap.common = found.lowest;
      return look;
    }
    note(found, look);
  }
  if constexpr (probe::kHasFaces<kindB>) {
    const FaceProbe found =
        probeFaces(CoreTag<kindB>{}, b, a, a_from_b.linear().transpose(), originOfAInB(a_from_b));
    if (found.inside) {
      look.inside = true;
      look.exact = false;  // if they touch, rounding may have reported a face of a as separating
      look.gap.distance = 0.0;
      look.gap.normal = -(a_from_b.linear() * found.normal);
      look.gap.common = a_from_b * found.lowest;
      return look;
    }
    if (found.separation > look.separation) {
      note(found, look);
      look.normal = -(a_from_b.linear() * look.normal);
      if (look.exact) {
        look.gap.normal = look.normal;
        std::swap(look.gap.pointA, look.gap.pointB);
        look.gap.pointA = a_from_b * look.gap.pointA;
        look.gap.pointB = a_from_b * look.gap.pointB;
      }
    }
  }
  return look;
}

}  // namespace swept::detail
