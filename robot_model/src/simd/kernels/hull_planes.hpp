// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// Unit vector in the model frame, from a pair's first body to its second, at the middle of a lane.
struct SimdDirection {
  float towards[3] = {};
  int lane = 0;
};

/// Whether planes can be found for a pair: both bodies have hulls, or the obstacle is a ball, a
/// capsule, a cylinder or a box.
bool canDivide(const SimdModel& model, std::uint32_t pair);

/// The lanes, among the given ones, in which a plane orthogonal to the direction is proven to
/// separate the two bodies of a pair for the whole sub-interval. The pair must be one that can be
/// divided; the frames of its bodies must be placed.
std::uint32_t lanesDivided(const SimdModel& model, std::uint32_t pair,
                           const SimdDirection& direction, std::uint32_t lanes,
                           SimdScratch& scratch);
/// The same for planes that it finds itself, of a pair with an obstacle: steps towards the point of
/// the hull that is nearest to the obstacle at each lane's middle (E. Gilbert, 1966; M. Frank and
/// P. Wolfe, 1956). The obstacle's nearest point, and so the plane, is known in closed form.
std::uint32_t lanesOutward(const SimdModel& model, std::uint32_t pair, std::uint32_t lanes,
                           SimdScratch& scratch);

}  // namespace swept::detail
