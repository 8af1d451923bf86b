// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/core/arithmetic.hpp"

/// Every tolerance of swept: its unit, its value and what breaks when it moves.
namespace swept::tolerance {

/// rad or m of motion, as metres of the moving geometry. A motion that keeps more than margin +
/// this is always decided. Smaller: fewer Undecided, more time on motions that graze.
inline constexpr double kMotion = 1e-3;

/// Relative (no unit). Bound on the accumulated rounding of a pose, per unit of coordinate
/// magnitude and per joint of the chain. A double rounds by 1.1e-16, and the operations of one
/// joint (Rodrigues rotation, product, translation) are fewer than 60. Smaller than that product: a
/// Free could be wrong by rounding. Larger: only more Undecided.
inline constexpr double kRoundingPerJoint = 2e-14;

/// Relative (no unit). Bound on the rounding of one support evaluation and of the separation
/// computed from it, per unit of coordinate magnitude: fewer than 40 operations of 1.1e-16 each.
/// Smaller than that: a proven separation could be wrong by rounding. Larger: more Undecided at
/// large coordinates.
inline constexpr double kSupportRounding = 1e-14;

/// m. Convergence of a distance query whose caller asks for no other: upper - lower.
/// Smaller: more iterations on curved pairs, and no convergence below about 1e-14 of the
/// coordinates.
inline constexpr double kDistance = 1e-9;

/// m. Accuracy of the libccd backend, which has no distance of its own (bisection on inflation).
inline constexpr double kLibccdDistance = 1e-6;

/// Relative to the mesh's size. Vertices closer than this are one vertex. Zero: STL files, which
/// repeat every vertex per triangle, still weld, since equal numbers are equal. Larger would close
/// real gaps, and a surface would be taken for a solid.
inline constexpr double kWeld = 0.0;

/// Relative to the largest coordinate. A point is left out of a convex hull only when it is proven
/// this close to the hull of those kept. Smaller: more vertices than the hull needs. Larger: hulls
/// report, and queries add, that much more error.
inline constexpr double kHull = 1e-12;

/// rad. How far a revolute or continuous value, and m for a prismatic one, may pass its limit and
/// still be within it: the rounding of degrees to radians in files. Larger: hardware limits are not
/// kept.
inline constexpr double kLimit = 1e-9;

/// Enforced cap on the intervals examined in one motion; what is left is Undecided.
inline constexpr int kMaxIntervals = 1 << 20;

/// Enforced cap on the intervals of continuousCollide() that stay unproven without a contact: what
/// grazes for longer is Undecided. Larger: more time on such motions.
inline constexpr int kMaxGrazing = 256;

/// Relative to the largest difference of two coordinates of the features. The least tolerance of
/// vertexFaceImpact() and edgeEdgeImpact(), far above the few dozen roundings of 1.1e-16 that their
/// proofs and nearest points lose. Smaller: many more intervals, below 1e-14 Undecided. Larger:
/// contact is seen where there is none.
inline constexpr double kImpact = 1e-12;

/// Enforced cap on the intervals that one impact of two features is looked for in. The most that
/// one of a million queries of the tests has needed is a sixth of it.
inline constexpr int kMaxImpactTests = 1 << 16;

/// Enforced cap on the iterations of one convex distance query.
inline constexpr int kMaxGjkIterations = 128;

}  // namespace swept::tolerance
