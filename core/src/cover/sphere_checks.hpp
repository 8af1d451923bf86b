// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "swept/core/enclosing_spheres.hpp"

namespace swept::detail {

/// Throws std::invalid_argument for a sphere whose centre is not finite, or whose radius is below 0
/// or not finite.
void requireSpheres(std::span<const EnclosingSphere> spheres);

/// Throws std::invalid_argument unless the value of an option is at least (`above`: more than)
/// `least`.
void requireSphereOption(const char* name, double value, double least, bool above = false);

}  // namespace swept::detail
