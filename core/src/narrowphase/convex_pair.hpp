// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "narrowphase/gjk.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept::detail {

/// Distance of two convex bodies: a closed form where the pair has one, else GJK.
GjkResult convexPair(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b,
                     const Eigen::Vector3d& guess, const Goal& goal, double contact,
                     double tolerance, GjkMode mode);

/// Signed distance of two convex bodies: a closed form where the pair has one, else GJK and EPA.
SignedDistanceResult convexPairSigned(const Convex& a, const Convex& b,
                                      const Eigen::Isometry3d& a_from_b, double tolerance);

/// Whether a shape is one convex body.
template <typename Body>
concept ConvexShape = requires(const Body& body) {
  Convex::of(body);
};

/// The public queries for two convex shapes and a finite pose; false, with `result` untouched,
/// unless both shapes are convex.
bool convexDistance(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                    const DistanceOptions& options, DistanceResult& result);
bool convexSigned(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                  double tolerance, SignedDistanceResult& result);
bool convexCollide(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                   Contact& result);

}  // namespace swept::detail
