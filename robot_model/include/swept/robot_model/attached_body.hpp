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
  struct Part {
    Shape shape;  ///< no plane and no half-space
    Eigen::Isometry3d link_from_shape;
  };
  std::string name;
  std::string link;
  std::vector<Part> parts = {};
  std::vector<std::string> touchLinks = {};  ///< may be in contact with it: a gripper's fingers
};

}  // namespace swept
