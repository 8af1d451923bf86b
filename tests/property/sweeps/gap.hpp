// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "body.hpp"
#include "path.hpp"

namespace sweeps {

/// How far apart two bodies are at most: of two points, one of each, that are convex combinations
/// of what the shapes' definitions give, so that a wrong search can only miss a contact, never
/// invent one. Of bodies in overlap it is 0 but for rounding.
class Gap {
 public:
  Gap(const Body& a, const Body& b) : a_(a), b_(b) {}
  /// m; pose of b in a's frame.
  double operator()(const Isometry3d& a_from_b);

 private:
  double bounded(const Isometry3d& a_from_b);
  bool enclosed(const Isometry3d& a_from_b) const;

  const Body& a_;
  const Body& b_;
  std::size_t bestA_ = 0, bestB_ = 0;  ///< parts that were closest, to be looked at first
};

/// b in a's frame, rounded once.
Isometry3d relative(const Path& a, const Path& b, Real t);

/// Whether a surface of triangles winds around p.
bool windsAround(const std::vector<std::array<Vector3d, 3>>& shell, const Vector3d& p);

/// m, about: how far a point is outside of a body; 0 within.
double outside(const Body& body, const Vector3d& p);

}  // namespace sweeps
