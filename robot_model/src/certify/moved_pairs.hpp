// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "swept/robot_model/checker.hpp"

namespace swept::detail {

/// A checker of those pairs that a delay moves against each other: between the two are a variable
/// of the delayed curve, and one of another curve. It keeps all pairs with moving obstacles, which
/// go on beside what rests while the delayed curve still moves, and all constraints. Every other
/// pair is free with every delay if it is free without one: it passes the same relative poses, at
/// other times.
///
/// `delayed`, `others`: names of variables. What no curve moves is at rest.
Checker delayedPairs(const Checker& checker, std::span<const std::string> delayed,
                     std::span<const std::string> others);

/// A checker of those pairs that the own variables move against each other, or against the world,
/// unless an ignored variable is between the two as well. It keeps all constraints.
///
/// `own`, `ignored`: names of variables.
Checker pairsMovedBy(const Checker& checker, std::span<const std::string> own,
                     std::span<const std::string> ignored);

}  // namespace swept::detail
