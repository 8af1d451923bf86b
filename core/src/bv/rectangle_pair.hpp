// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace swept::detail {

/// Two rectangles swept by spheres, in the axes of the first, which spans x and y about the origin.
struct RectanglePair {
  Eigen::Vector3d offset;      ///< m, middle of the second rectangle
  Eigen::Vector3d firstAxis;   ///< unit, of the second rectangle
  Eigen::Vector3d secondAxis;  ///< unit, of the second rectangle
  Eigen::Vector2d halfA;       ///< m
  Eigen::Vector2d halfB;       ///< m
  double radii;                ///< m, sum of the two
  double margin;               ///< m; only a gap of more than this is proven
};

/// True only if the swept rectangles are proven apart.
bool separated(const RectanglePair& pair);

/// m; proven lower bound on the distance of the swept rectangles, within 1e-3 of it; 0 where they
/// overlap and for what is not finite.
double gapBound(const RectanglePair& pair);

}  // namespace swept::detail
