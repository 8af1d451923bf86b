// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <utility>
#include <vector>

#include "io/input_source.hpp"
#include "io/mesh_store.hpp"
#include "io/warning_kinds.hpp"
#include "io/yaml.hpp"
#include "swept/core/shapes.hpp"
#include "swept/robot_model/world.hpp"

namespace swept::detail {

/// The content of a moveit_msgs/CollisionObject, in the frame that its header names.
struct SceneObject {
  struct Part {
    Shape shape;
    Eigen::Isometry3d header_from_shape;
  };
  std::string id;
  std::vector<Part> parts;
  /// The frames of the object (`id`) and of its subframes (`id/name`), which other poses may name.
  std::vector<std::pair<std::string, Eigen::Isometry3d>> header_from_frame;
  /// Of an object that moves, in the frame that its header names: the parts are then in the
  /// object's own frame, and there are no frames.
  std::vector<MovingObstacle::Waypoint> motion = {};
};

/// Reads the objects of one file, whose meshes they share.
class SceneObjects {
 public:
  explicit SceneObjects(const InputSource& source)
      : source_(source), meshes_(source), warnings_(source) {}

  /// Throws InputError for an operation other than ADD; for a pose, subframes or planes of an
  /// object with a motion; and for any other error in it. The object may have no parts.
  SceneObject read(const YamlPlace& object, const std::string& id);
  /// Gives the warnings that need all objects to be read.
  void flushWarnings() { warnings_.flush(); }

 private:
  void addShapes(const YamlPlace& object, const char* shapesKey, const char* posesKey,
                 SceneObject& result);
  Shape readMesh(const YamlPlace& place, const std::string& id);

  const InputSource& source_;
  MeshStore meshes_;
  WarningKinds warnings_;
};

/// The `id`. Throws InputError if it is missing.
std::string idOf(const YamlPlace& object);

}  // namespace swept::detail
