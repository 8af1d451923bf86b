// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace swept::detail {

/// What a mesh file holds, before it is welded.
struct MeshFileContent {
  std::vector<Eigen::Vector3d> vertices;   ///< in the file's frame and unit
  std::vector<Eigen::Vector3i> triangles;  ///< indices into vertices
  double loss = 0.0;                       ///< how far coordinates may be from the file's; its unit
};

/// A mesh file that cannot be used; what() says why, without the file's name.
struct MeshFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws MeshFileError for more than 20 million.
void requireFewTriangles(std::uint64_t count);

/// Reads .stl, .obj, .dae and .ply, in letters of any size. Polygons are triangulated, points and
/// lines dropped, node transforms applied.
///
/// All faces are there: small readers of ours (mesh_claim.hpp) count them first, refuse what is
/// out of range, cut off or in words that they do not know, and what assimp returns must have as
/// many triangles and reach as far.
///
/// Coordinates pass through single precision, as assimp has them. `loss` bounds what that changes
/// in the words of the file, and has what it changes in the box of the whole once nodes are
/// applied: some 1e-7 of the largest coordinate, none where the file itself has single precision.
/// Nothing else counts it.
///
/// COLLADA: `<unit>` is applied, so that lengths are metres. `<up_axis>` is not: robot descriptions
/// take the coordinates as they stand in the file (what RViz and MoveIt show), while assimp by
/// itself would turn a Z_UP file so that y points up.
///
/// Assimp runs in a process of its own, for as long and with as much memory as a file of that size
/// can reasonably take: one that makes it crash or hang is refused as any other.
///
/// No other file is opened, not even one that this file names (materials, textures, buffers).
/// Throws MeshFileError for another ending, a file over 256 MB, one with more than 20 million
/// triangles, one that cannot be read whole, or one without triangles, and where no process can be
/// made.
MeshFileContent readMeshFile(const std::filesystem::path& file);

}  // namespace swept::detail
