// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace swept::detail {

/// What a mesh file holds, before it is welded.
struct MeshFileContent {
  std::vector<Eigen::Vector3d> vertices;   ///< in the file's frame and unit
  std::vector<Eigen::Vector3i> triangles;  ///< indices into vertices
};

/// A mesh file that cannot be used; what() says why, without the file's name.
struct MeshFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads STL, OBJ, COLLADA, PLY and whatever else assimp knows. Polygons are triangulated, points
/// and lines dropped, node transforms applied. Coordinates pass through float, as assimp has them.
///
/// COLLADA: `<unit>` is applied, so that lengths are metres. `<up_axis>` is not: robot descriptions
/// take the coordinates as they stand in the file (what RViz and MoveIt show), while assimp by
/// itself would turn a Z_UP file so that y points up.
///
/// Assimp runs in a process of its own, for as long and with as much memory as a file of that size
/// can reasonably take: one that makes it crash or hang is refused as any other.
///
/// No other file is opened, not even one that this file names (materials, textures, buffers).
/// Throws MeshFileError for a file over 256 MB, one with more than 20 million triangles, one that
/// assimp cannot read, or one without triangles, and where no process can be made.
MeshFileContent readMeshFile(const std::filesystem::path& file);

}  // namespace swept::detail
