// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "swept/core/shapes.hpp"

namespace swept {

/// m, proven: the ball of this radius around `point` (m, the shape's frame) lies in the solid. 0
/// where the point is outside or on its surface, for surfaces (see `MeshInterior`), and for a point
/// that is not finite. For meshes and for primitives it is the distance from the surface but for
/// roundings, for meshes 4e-6 of their extent and of the point's distance from their middle
/// (1-norms); a mesh of several closed components that overlap may be deeper.
double solidDepth(const Shape& shape, const Eigen::Vector3d& point);

}  // namespace swept
