// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "swept/core/triangle_mesh.hpp"

namespace swept {

/// Terrain over a rectangle, as a closed solid from z = `base` up to the heights.
///
/// The rectangle is xSize by ySize (m) and centred at the origin. Heights (m) are samples at the
/// nodes of a regular grid: columns run along x and rows along y. heights(0, 0) is at (-xSize/2,
/// -ySize/2), and the last row and column at the opposite corner. Each cell is two triangles, split
/// along the diagonal from its lowest to its highest x and y.
///
/// Throws std::invalid_argument, naming the value, unless both sizes are finite and greater than
/// zero, there are at least two rows and two columns, all numbers are finite, and every height is
/// greater than `base`.
TriangleMesh heightField(double xSize, double ySize, const Eigen::MatrixXd& heights, double base);

}  // namespace swept
