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
  /// Consecutive triangles, and the name of the material that they share.
  struct Group {
    std::size_t triangles = 0;
    std::string material;
  };
  MeshFileContent content;  ///< in the mesh's frame and unit; no colours
  std::vector<Group> groups;
};

/// Reads the mesh in the forms of README, "Which meshes are read". Throws if anything is missing
/// that the faces and the positions of their corners name or count. Ignores sources that give a
/// face no corner (normals, colours).
ColladaMesh readColladaMesh(const tinyxml2::XMLElement& mesh, const InputSource& source,
                            FaceCutter& cutter);

}  // namespace swept::detail
