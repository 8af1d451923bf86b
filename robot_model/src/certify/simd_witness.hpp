// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "certify/pair_query.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// m, model frame: a point of each body of a contact, the two at most the margin apart.
struct ContactPoints {
  Eigen::Vector3d a;
  Eigen::Vector3d b;
};

/// The points of a contact that the SIMD tier found, confirmed on exact geometry in double
/// precision: of two links, both are examined at the query's t; of a link and an obstacle, the
/// obstacle. `pair`: the contact's. Empty if it is not confirmed.
std::optional<ContactPoints> contactPoints(const CheckerModel& model, PairQuery& query,
                                           const GeometryPair& pair, const SimdContact& contact);

/// The same, as a witness.
std::optional<Witness> simdWitness(const CheckerModel& model, PairQuery& query,
                                   const GeometryPair& pair, const SimdContact& contact, double t);

/// A witness for a point (m, model frame) of the pair's link that is in the world geometry or
/// within the margin of it. Empty if it is not.
std::optional<Witness> pointWitness(const CheckerModel& model, std::uint32_t pair,
                                    const Eigen::Vector3d& point, double t);

}  // namespace swept::detail
