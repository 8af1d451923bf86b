// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/face_cutter.hpp"
#include "io/input_source.hpp"
#include "io/mesh_content.hpp"

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace swept::detail {

/// The faces of a <mesh> of COLLADA.
struct ColladaMesh {
  /// Of triangles one after the other, and what names their material.
  struct Group {
    std::size_t triangles = 0;
    std::string material;
  };
  MeshFileContent content;  ///< in the mesh's frame and unit; no colours
  std::vector<Group> groups;
};

/// Fails unless all is there that the faces and the positions of their corners name and count, in
/// the forms that README, "Which meshes are read", has. A source that gives no face a corner
/// (normals, colours) is not looked at.
ColladaMesh readColladaMesh(const tinyxml2::XMLElement& mesh, const InputSource& source,
                            FaceCutter& cutter);

}  // namespace swept::detail
