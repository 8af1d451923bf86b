// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "narrowphase/gjk.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept::detail {

/// Pairs of which at least one is a plane or a half-space: closed forms over the other's support
/// points. Planes and half-spaces whose normals agree or oppose within tolerance::kParallel count
/// as parallel; all others meet.
///
/// Lemma: for unit normals n of a and m of b with |n -+ m| <= k = tolerance::kParallel up to the
/// rounding of both, a point p of b has n . p = +- m . p + (n -+ m) . p. So |p| <= r keeps it
/// within 2 k r of where it would be if b were parallel to a.

/// Like the answer of gjk(), with `upper` always witnessed.
GjkResult flatPair(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b,
                   const Goal& goal);

/// Whether a plane or half-space and the other body share a point.
Contact flatCollide(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b);

/// For a plane and a body on both sides of it: minus the shorter way out. -infinity (both bounds)
/// if no translation separates: crossing planes and half-spaces.
SignedDistanceResult flatPairSigned(const Convex& a, const Convex& b,
                                    const Eigen::Isometry3d& a_from_b);

}  // namespace swept::detail
