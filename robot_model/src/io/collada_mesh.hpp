// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "io/crossing_face.hpp"
#include "io/input_source.hpp"
#include "io/mesh_claim.hpp"

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace swept::detail {

/// The faces of a <mesh> of COLLADA.
struct ColladaMesh {
  std::uint64_t triangles = 0;           ///< a polygon of n corners counts n - 2
  std::vector<Eigen::Vector3d> corners;  ///< of all faces, each vertex once; the mesh's unit
  double loss = 0.0;                     ///< at most, of a coordinate in single precision
};

/// Fails unless all is there that the faces and the positions of their corners name and count, in
/// the forms that assimp understands: it does not look before it follows them. A source that gives
/// no face a corner (normals, colours) is not looked at. What is left of `mesh` afterwards are the
/// faces and one source of positions. `crossing` looks at the faces.
ColladaMesh readColladaMesh(tinyxml2::XMLElement& mesh, const InputSource& source,
                            CrossingFace& crossing, FaceMaterials materials);

}  // namespace swept::detail
