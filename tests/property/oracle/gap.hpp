// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "primitive.hpp"

namespace oracle {

/// An interval that holds a distance (m), usually of no length.
struct Gap {
  double lower;
  double upper;
};

/// Distances of what does not overlap. Those beyond `enough` may be given as `enough`.
Gap gap(const Triangle& a, const Triangle& b, double enough);
/// The triangle is in the solid's frame.
Gap gap(const Primitive& solid, const Triangle& triangle, double enough);
Gap gap(const Primitive& a, const Primitive& b, const Isometry3d& a_from_b);

/// Between overlapping ones too; stops when points at most `contact` (m) apart are found.
Gap cylinderGap(const Cylinder& a, const Cylinder& b, const Isometry3d& a_from_b, double contact);
/// m, of a capsule's axis from a solid; 0 where it enters.
double axisDistance(const Capsule& capsule, const Primitive& solid,
                    const Isometry3d& solid_from_capsule);

}  // namespace oracle
