// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "output/text_output.hpp"
#include "swept/core/shapes.hpp"

namespace swept {

/// `box 0.1 x 0.2 x 0.3 m`, `mesh of 812 triangles, closed, hull of 96 points`, ...
std::string shapeText(const Shape& shape);

/// The same facts under names: `kind`, then sizes (m), or `triangles`, `closed`, `hull_points`.
Json shapeJson(const Shape& shape);

}  // namespace swept
