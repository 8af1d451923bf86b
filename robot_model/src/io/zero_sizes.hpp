// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "io/warning_kinds.hpp"
#include "swept/core/shapes.hpp"

namespace swept::detail {

/// Whether a primitive is a point, a segment or a surface, since a size of it is 0. Meshes, hulls
/// and the like are not looked at.
bool hasZeroSize(const Shape& shape);

/// Warns of one that does, which `owner` has (`object 'shelf'`).
void warnOfZeroSize(const Shape& shape, int line, const std::string& owner, WarningKinds& warnings);

/// What there is to say of one; of several, with a `#` for their number.
inline constexpr const char* kZeroSize =
    "a shape with a size of 0 is checked as the point, segment or surface that it is";
inline constexpr const char* kZeroSizes =
    "# shapes with a size of 0 are checked as the points, segments and surfaces that they are";

}  // namespace swept::detail
