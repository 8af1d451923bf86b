// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "swept/core/shapes.hpp"
#include "swept/core/sphere_cover.hpp"

namespace swept::detail {

/// Whether a ball contains it: neither a plane nor a half-space.
bool isBounded(const Shape& shape);

/// Equal sizes, or copies of the same mesh, hull or cloud.
bool areSame(const Shape& a, const Shape& b);

/// How fine the covers of bodies that move are.
inline constexpr double kCoverOverhang = 0.005;       ///< m, of the finest level, but ...
inline constexpr double kCoverRelative = 1.0 / 32.0;  ///< ... not less of the first ball's radius
/// Balls inside a link: where contacts are looked for first.
inline constexpr int kMostInnerBalls = 64;

/// The balls that stand for a body that moves; null for an unbounded shape.
std::shared_ptr<const SphereCover> coverOf(const Shape& shape);

}  // namespace swept::detail
