// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "narrowphase/piece_pair.hpp"

namespace swept::detail {

/// The penetration depth of two bodies in contact, of which at least one is a mesh, as an interval.
struct MeshDepth {
  double lower = 0.0;  ///< m, no shorter translation separates the two
  double upper = 0.0;  ///< m, moving b by this along `normal` separates them (infinity: none found)
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, a's frame, from a to b
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();  ///< m, a's frame: where `lower` was found
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();  ///< m, a's frame
  int iterations = 0;
};

/// `upper` comes from the hulls: separating them separates the meshes. `lower` comes from pairs of
/// convex parts, each of which must be separated, and from balls inside one body whose centres are
/// deep inside the other. Exact, to `tolerance`, if each body is one convex part.
MeshDepth meshDepth(const Side& a, const Side& b, const Eigen::Isometry3d& a_from_b,
                    double tolerance);

}  // namespace swept::detail
