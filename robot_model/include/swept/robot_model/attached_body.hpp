// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "swept/core/shapes.hpp"

namespace swept {

/// A rigid body that a link carries: a tool, or what a gripper holds. It is checked as the link is,
/// but neither against that link nor against the touch links. Its name must not be that of a link
/// or of a body of the world.
struct AttachedBody {
  /// A piece of its geometry.
  struct Part {
    Shape shape;                        ///< no plane and no half-space
    Eigen::Isometry3d link_from_shape;  ///< pose of the shape in the link's frame
  };
  std::string name;              ///< as rules and reports call it
  std::string link;              ///< that carries it
  std::vector<Part> parts = {};  ///< its geometry
  /// Links that may be in contact with it: a gripper's fingers. As in CollisionRules, a `*` in a
  /// name stands for any characters, or none.
  std::vector<std::string> touchLinks = {};
};

}  // namespace swept
