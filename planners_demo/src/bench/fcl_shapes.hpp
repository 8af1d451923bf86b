// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// FCL's headers are not held to our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <fcl/fcl.h>
#pragma GCC diagnostic pop

#include <memory>
#include <string>

#include "swept/core/shapes.hpp"

namespace swept {

/// The same set of points for FCL, of which meshes are hollow; a cloud is an octree of cubes around
/// its points. `body` is for messages. Throws UsageError for a cloud whose balls differ in size or
/// are points.
std::shared_ptr<fcl::CollisionGeometryd> fclGeometry(const Shape& shape, const std::string& body);

}  // namespace swept
