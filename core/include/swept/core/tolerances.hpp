// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/core/arithmetic.hpp"

/// The tolerances that callers meet or that several files share: the unit, the value and what
/// breaks when it moves. What one file alone needs stands there, with the reason for its value.
namespace swept::tolerance {

/// m. Tolerance of a motion's check whose caller asks for no other: a motion that keeps more than
/// margin + this is always decided. Smaller: fewer Undecided, more time on motions that graze.
inline constexpr double kMotion = 1e-3;

/// Relative (no unit). Bound on the accumulated rounding of a pose, per unit of coordinate
/// magnitude and per joint of the chain; a motion's own pose, and the product of two, count as one
/// joint each. A double rounds by 1.1e-16, and the operations of one joint (Rodrigues rotation,
/// product, translation) are fewer than 60. Smaller than that product: a Free could be wrong by
/// rounding. Larger: only more Undecided.
inline constexpr double kRoundingPerJoint = 2e-14;

/// Relative (no unit). Bound on the rounding of one support evaluation and of the separation
/// computed from it, or of as few steps of a closed form, per unit of coordinate magnitude: fewer
/// than 40 operations of 1.1e-16 each. Smaller than that: a proven separation could be wrong by
/// rounding. Larger: more Undecided at large coordinates.
inline constexpr double kSupportRounding = 1e-14;

/// rad. Planes and half-spaces whose normals agree or oppose within this are taken for parallel:
/// the rounding of a pose is enough to make parallel ones meet far out. A `lower` of theirs is then
/// proven of what is within reach: what of the two is within r (m) of the first one's origin is at
/// least lower - 2 kParallel r apart. Smaller: parallel planes meet after a pose has rounded.
/// Larger: a shorter reach.
inline constexpr double kParallel = 1e-12;

/// m. Convergence of a distance query whose caller asks for no other: upper - lower.
/// Smaller: more iterations on curved pairs, and no convergence below about 1e-14 of the
/// coordinates.
inline constexpr double kDistance = 1e-9;

/// m. Accuracy of the libccd backend, which has no distance of its own (bisection on inflation).
inline constexpr double kLibccdDistance = 1e-6;

/// Relative to the largest coordinate. A point is left out of a convex hull only when it is proven
/// this close to the hull of those kept. Smaller: more vertices than the hull needs. Larger: hulls
/// report, and queries add, that much more error.
inline constexpr double kHull = 1e-12;

/// rad, and m for a prismatic value. How far a value may be beyond its limit and still stand for
/// it: 1e-5, and as much more as such a decimal rounds by. Messages of ROS carry single precision
/// (3 rad round by 1e-7), and files and people give five digits. Smaller: such values are refused.
/// Larger: hardware limits are not kept.
inline constexpr double kLimit = 1.000001e-5;

/// Enforced cap on the intervals examined in one motion whose caller asks for no other; what is
/// left is Undecided.
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

/// Enforced cap on the iterations of one descent of GJK. A convex distance query makes one, and a
/// second, more careful one where that gets stuck.
inline constexpr int kMaxGjkIterations = 128;

}  // namespace swept::tolerance
