// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/child_process.hpp"
#include "io/mesh_claim.hpp"

namespace swept::detail {

/// Of a face without a material, or whose material is a picture.
inline constexpr std::uint32_t kNoColour = 0xFFFFFFFF;

/// What a mesh file holds, before it is welded.
struct MeshFileContent {
  std::vector<Eigen::Vector3d> vertices;   ///< in the file's frame and unit
  std::vector<Eigen::Vector3i> triangles;  ///< indices into vertices
  double loss = 0.0;                       ///< how far coordinates may be from the file's; its unit
  /// 0xRRGGBB of each triangle, or kNoColour; empty: the file has no colours, or nobody asked.
  std::vector<std::uint32_t> colours;
};

/// A mesh file that cannot be used; what() says why, without the file's name.
struct MeshFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws MeshFileError for more than 20 million.
void requireFewTriangles(std::uint64_t count);

/// What makes a mesh of a file's bytes; the name tells the format. Throws MeshFileError and
/// std::bad_alloc.
using MeshImport =
    std::function<MeshFileContent(const std::string& name, std::span<const std::uint8_t> bytes)>;

/// Reads .stl, .obj, .dae and .ply, in letters of any size. Polygons are triangulated, points and
/// lines dropped, node transforms applied.
///
/// All faces are there: small readers of ours (mesh_claim.hpp) count them first, refuse what is
/// out of range, cut off or in words that they do not know, and what assimp returns must have as
/// many triangles and reach as far.
///
/// Nothing else of a file is judged: assimp gets the faces and their corners alone (bytes that mean
/// any number stay), and normals, colours, textures, materials, cameras and lights cost no file,
/// whatever they hold.
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
/// can reasonably take: one that makes it crash or hang is refused as any other. That process reads
/// one file after the other, each within limits of its own, as long as it reads them whole; one
/// that failed at a file reads no other, and a file is refused only by one that has read no other.
///
/// No other file is opened, not even one that this file names (materials, textures, buffers).
/// Throws MeshFileError for another ending, a file over 256 MB, one with more than 20 million
/// triangles, one that cannot be read whole, or one without triangles, and where no process can be
/// made, and reads the next file nevertheless. One thread uses it, and outlives it.
class MeshFileReader {
 public:
  MeshFileReader();
  /// With something else in place of assimp.
  explicit MeshFileReader(MeshImport import);

  MeshFileContent read(const std::filesystem::path& file);
  /// The same with the colours that a COLLADA file's materials have. What is wrong with these costs
  /// the colours, not the file.
  MeshFileContent readWithColours(const std::filesystem::path& file);

 private:
  MeshFileContent readAs(const std::filesystem::path& file, FaceMaterials materials);
  MeshFileContent ask(const std::string& name, std::string_view text);
  /// All that `claim` says there is.
  MeshFileContent askForWhole(const std::string& name, std::string_view text,
                              const MeshClaim& claim);

  ChildProcess child_;
};

}  // namespace swept::detail
