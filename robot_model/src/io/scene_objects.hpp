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

namespace swept::detail {

/// What a moveit_msgs/CollisionObject holds, in the frame that its header names.
struct SceneObject {
  struct Part {
    Shape shape;
    Eigen::Isometry3d header_from_shape;
  };
  std::string id;
  std::vector<Part> parts;
  /// The object itself (`id`) and its subframes (`id/name`), as other poses may name them.
  std::vector<std::pair<std::string, Eigen::Isometry3d>> header_from_frame;
};

/// Reads the objects of one file, whose meshes they share.
class SceneObjects {
 public:
  explicit SceneObjects(const InputSource& source)
      : source_(source), meshes_(source), warnings_(source) {}

  /// Throws InputError for an operation other than ADD, and what else is wrong in it. It may have
  /// no parts.
  SceneObject read(const YamlPlace& object, const std::string& id);
  /// What there is to warn of only once all are read.
  void flushWarnings() { warnings_.flush(); }

 private:
  void addShapes(const YamlPlace& object, const char* shapesKey, const char* posesKey,
                 SceneObject& result);
  Shape readMesh(const YamlPlace& place, const std::string& id);

  const InputSource& source_;
  MeshStore meshes_;
  WarningKinds warnings_;
};

/// The `id`. Throws InputError for none.
std::string idOf(const YamlPlace& object);

}  // namespace swept::detail
