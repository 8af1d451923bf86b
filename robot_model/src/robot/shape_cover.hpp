// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "swept/core/shapes.hpp"
#include "swept/core/sphere_cover.hpp"

namespace swept::detail {

/// Whether a ball can contain it: it is neither a plane nor a half-space.
bool isBounded(const Shape& shape);

/// Whether two shapes have equal sizes, or are copies of the same mesh, hull or cloud.
bool areSame(const Shape& a, const Shape& b);

/// Resolution of the covers of moving bodies.
inline constexpr double kCoverOverhang = 0.005;       ///< m, of the finest level, but ...
inline constexpr double kCoverRelative = 1.0 / 32.0;  ///< ... not less of the first ball's radius
/// Balls inside a link: the search for contacts starts with them.
inline constexpr int kMostInnerBalls = 64;

/// The balls that stand for a moving body; null for an unbounded shape.
std::shared_ptr<const SphereCover> coverOf(const Shape& shape);

}  // namespace swept::detail
