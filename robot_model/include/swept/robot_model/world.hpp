// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "swept/core/shapes.hpp"
#include "swept/robot_model/input.hpp"

namespace swept {

/// A named rigid obstacle: one or more shapes, fixed in the robot's model frame.
struct WorldBody {
  struct Part {
    Shape shape;
    Eigen::Isometry3d world_from_shape;
  };
  std::string name;
  std::vector<Part> parts;
};

/// The obstacles around a robot, in its model frame (the URDF's root link, or the parent frame of the
/// SRDF's virtual joint).
class World {
 public:
  /// Reads planning-scene YAML (moveit_msgs layout, `.yaml`/`.yml`) or MoveIt text (`.scene`), told
  /// apart by the file's ending. Throws InputError.
  static World load(const std::filesystem::path& scene, const LoadOptions& options = {});

  /// Throws std::invalid_argument when the name is taken or a pose is not a rigid finite transform.
  void add(WorldBody body);
  void add(std::string name, Shape shape, const Eigen::Isometry3d& world_from_shape);

  const std::vector<WorldBody>& bodies() const { return bodies_; }
  const WorldBody* find(std::string_view name) const;

 private:
  std::vector<WorldBody> bodies_;
};

}  // namespace swept
