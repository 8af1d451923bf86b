// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "certify/checker_model.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// m, model frame: a point of both bodies of a contact that the lane tier found, checked on the
/// exact obstacle in double precision. Empty if the check does not confirm it.
std::optional<Eigen::Vector3d> commonPoint(const CheckerModel& model, const SimdContact& contact);

/// The same as a witness.
std::optional<Witness> simdWitness(const CheckerModel& model, const SimdContact& contact, double t);

/// Of a point (m, model frame) of the pair's link, in the world geometry or within the margin of
/// it; null: it is not.
std::optional<Witness> pointWitness(const CheckerModel& model, std::uint32_t pair,
                                    const Eigen::Vector3d& point, double t);

}  // namespace swept::detail
