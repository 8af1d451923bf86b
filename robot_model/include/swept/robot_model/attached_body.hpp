// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "swept/core/shapes.hpp"

namespace swept {

/// A rigid body that a link carries: a tool, or an object in a gripper. It is checked like the
/// link, but neither against that link nor against the touch links. Its name must differ from those
/// of all links and bodies of the world.
struct AttachedBody {
  /// A piece of its geometry.
  struct Part {
    Shape shape;                        ///< no plane and no half-space
    Eigen::Isometry3d link_from_shape;  ///< pose of the shape in the link's frame
  };
  std::string name;              ///< used in rules and reports
  std::string link;              ///< the link that carries it
  std::vector<Part> parts = {};  ///< its geometry
  /// Links that may touch it, such as a gripper's fingers. As in CollisionRules, a `*` in a name
  /// stands for any characters, or none.
  std::vector<std::string> touchLinks = {};
};

}  // namespace swept
