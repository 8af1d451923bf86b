// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "narrowphase/piece_pair.hpp"

namespace swept::detail {

/// Whether a point (m, a's frame) that is in both hulls is in both bodies, too: in a mesh it may
/// lie in a dent.
bool isInBoth(const Side& a, const Side& b, const Eigen::Isometry3d& a_from_b,
              const Eigen::Vector3d& pointInA);

/// A point (m, a's frame) of one body that a closed component of the other, a mesh, encloses. The
/// surfaces of the two do not meet. No value if there is no such point.
std::optional<Eigen::Vector3d> enclosedPoint(const Side& a, const Side& b,
                                             const Eigen::Isometry3d& a_from_b);

}  // namespace swept::detail
