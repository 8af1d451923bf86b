// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "output/text_output.hpp"
#include "swept/core/shapes.hpp"

namespace swept {

/// A shape as robot_model/verify reads it, bit for bit: small shapes as numbers, the others in
/// base64.
Json exactShapeJson(const Shape& shape);

}  // namespace swept
