// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "narrowphase/piece_findings.hpp"
#include "narrowphase/piece_motions.hpp"

namespace swept::detail {

/// Primitives of two sides that are likely to be among the nearest, as those at the nearest points
/// of the hulls are. -1: of a convex side, itself.
struct LikelyNearest {
  int primitiveA = -1;
  int primitiveB = -1;
  double lower = 0.0;  ///< m, proven distance of the hulls. 0: they may overlap.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< a's frame, the direction of `lower`
};

/// The primitive of a side nearest to a point (m, in its frame), within what rounding leaves. None:
/// the coordinates are not finite.
std::optional<int> nearestPrimitive(const Side& side, const Eigen::Vector3d& point);

/// Branch and bound over all pairs of pieces of two sides, not both of them convex. Adds to
/// `found`, whose hint (a's frame) is tried first; ends early in contact. The search begins at
/// `first`. If the distance found there is that of the hulls, within the tolerance, it ends there.
void descendPieces(const Side& a, const Side& b, const Eigen::Isometry3d& a_from_b,
                   const PieceMotions& motions, const std::optional<LikelyNearest>& first,
                   PieceFindings& found);

}  // namespace swept::detail
