// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>

#include "swept/core/bv/aabb.hpp"
#include "swept/core/clearance_field.hpp"
#include "swept/core/shapes.hpp"

namespace swept::detail {

/// `window` (m, shape's frame) meets the shape's box; `cells`: approximate maximum.
std::shared_ptr<const ClearanceField> buildField(const TriangleMesh& mesh, const Aabb& window,
                                                 std::size_t cells);
std::shared_ptr<const ClearanceField> buildField(const PointCloud& cloud, const Aabb& window,
                                                 std::size_t cells);

/// m; contains everything that its field is made from.
Aabb fieldBox(const TriangleMesh& mesh);
Aabb fieldBox(const PointCloud& cloud);

}  // namespace swept::detail
