// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "swept/core/shapes.hpp"

namespace swept {

/// m. Proven radius of a ball around `point` (m, the shape's frame) that lies in the solid. 0 if
/// the point is outside or on the surface, for surfaces (see `MeshInterior`), and for a non-finite
/// point. For meshes and primitives it is the distance from the surface up to rounding; for meshes
/// 4e-6 of their extent and of the point's distance from their centre (1-norms). A mesh of several
/// overlapping closed components may be deeper.
double solidDepth(const Shape& shape, const Eigen::Vector3d& point);

}  // namespace swept
