// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "primitive.hpp"

namespace oracle {

/// Exact up to rounding, and never a hit by more than 1e-9 m of wishful thinking: what these report
/// as overlapping does overlap or comes that close.

/// Edges that cross the other triangle's inside. Triangles in one plane do not count: in closed
/// meshes others cross then.
bool overlap(const Triangle& a, const Triangle& b);
/// The triangle is in the solid's frame.
bool overlap(const Primitive& solid, const Triangle& triangle);
bool overlap(const Primitive& a, const Primitive& b, const Isometry3d& a_from_b);

/// Whether two boxes come within `margin` of each other, as far as their six face normals tell:
/// false is certain.
class BoxFilter {
 public:
  explicit BoxFilter(const Isometry3d& a_from_b);
  bool near(const Vector3d& centerA, const Vector3d& halfA, const Vector3d& centerB,
            const Vector3d& halfB, double margin) const;

 private:
  Isometry3d a_from_b_;
  Eigen::Matrix3d absolute_;
};

}  // namespace oracle
