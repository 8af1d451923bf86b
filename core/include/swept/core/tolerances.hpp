// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/core/arithmetic.hpp"

/// The tolerances that callers meet or several files share, each with its unit, its value and what
/// breaks if it changes. A tolerance that only one file needs is in that file, with its reason.
namespace swept::tolerance {

/// m. Default tolerance of a motion's check. A motion that keeps more than margin + this is always
/// decided. Smaller: fewer Undecided, more time on motions that graze.
inline constexpr double kMotion = 1e-3;

/// Relative (no unit). Bound on the accumulated rounding of a pose, per unit of coordinate
/// magnitude and per joint of the chain. A motion's own pose, and the product of two, count as one
/// joint each. A double rounds by 1.1e-16, and the operations of one joint (Rodrigues rotation,
/// product, translation) are fewer than 60. Smaller than that product: rounding could make a Free
/// wrong. Larger: only more Undecided.
inline constexpr double kRoundingPerJoint = 2e-14;

/// Relative (no unit). Bound on the rounding of one support evaluation and its separation, or of
/// equally few steps of a closed form, per unit of coordinate magnitude: fewer than 40 operations
/// of 1.1e-16 each. Smaller than that: rounding could make a proven separation wrong. Larger: more
/// Undecided at large coordinates.
inline constexpr double kSupportRounding = 1e-14;

/// rad. Planes and half-spaces count as parallel if their normals agree or oppose within this,
/// since the rounding of a pose can make parallel ones meet far out. Their `lower` is then proven
/// only within reach: parts of the two within r (m) of the first one's origin are at least lower -
/// 2 kParallel r apart. Smaller: parallel planes meet after a pose has rounded. Larger: a shorter
/// reach.
inline constexpr double kParallel = 1e-12;

/// m. Default convergence of a distance query: upper - lower. Smaller: more iterations on curved
/// pairs, and no convergence below about 1e-14 of the coordinates.
inline constexpr double kDistance = 1e-9;

/// m. Accuracy of the libccd backend, which has no distance of its own (bisection on inflation).
inline constexpr double kLibccdDistance = 1e-6;

/// Relative to the largest coordinate. A point is left out of a convex hull only if it is proven
/// this close to the hull of the kept points. Smaller: more vertices than the hull needs. Larger:
/// hulls report, and queries add, that much more error.
inline constexpr double kHull = 1e-12;

/// rad, and m for a prismatic value. A value this far beyond its limit still counts as the limit:
/// 1e-5 plus the rounding of such a decimal. Messages of ROS carry single precision (3 rad round by
/// 1e-7), and files and people give five digits. Smaller: such values are refused. Larger: hardware
/// limits are not kept.
inline constexpr double kLimit = 1.000001e-5;

/// Relative (no unit). A rate this far beyond its limit still counts as the limit: files give their
/// velocities and accelerations in seven digits or fewer, and a curve through rounded positions is
/// off by as much. Smaller: such curves are said to be too fast. Larger: limits are not kept.
inline constexpr double kRateLimit = 1e-6;

/// Default cap on the intervals examined in one motion; beyond it the rest is Undecided.
inline constexpr int kMaxIntervals = 1 << 20;

/// Cap on the intervals of continuousCollide() that stay unproven without a contact; a longer graze
/// is Undecided. Larger: more time on such motions.
inline constexpr int kMaxGrazing = 256;

/// Relative to the largest difference of two coordinates of the features. The least tolerance of
/// vertexFaceImpact() and edgeEdgeImpact(). It is far above the few dozen roundings of 1.1e-16 in
/// their proofs and nearest points. Smaller: many more intervals, below 1e-14 Undecided. Larger:
/// false contacts.
inline constexpr double kImpact = 1e-12;

/// Cap on the intervals of one impact query of two features. The most that one of a million test
/// queries needed is a sixth of it.
inline constexpr int kMaxImpactTests = 1 << 16;

/// Cap on the iterations of one descent of GJK. A convex distance query makes one descent, and a
/// second, more careful one if that gets stuck.
inline constexpr int kMaxGjkIterations = 128;

}  // namespace swept::tolerance
