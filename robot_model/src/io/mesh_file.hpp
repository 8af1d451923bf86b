// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "io/child_process.hpp"
#include "io/gltf_summary.hpp"
#include "io/mesh_content.hpp"
#include "io/mesh_readers.hpp"

namespace swept::detail {

/// What makes a mesh of a file's bytes; the name tells the format. Throws MeshFileError and
/// std::bad_alloc.
using MeshImport =
    std::function<MeshFileContent(const std::string& name, std::span<const std::uint8_t> bytes)>;

/// Where files are read that assimp reads.
enum class ImportPlace { Child, Here };

inline ImportPlace importPlaceOf(const LoadOptions& options) {
  return options.childProcess ? ImportPlace::Child : ImportPlace::Here;
}

/// Reads .stl, .obj, .dae, .ply, .off, .gltf and .glb, in letters of any size. Polygons are
/// triangulated (FaceCutter), points and lines dropped, node transforms applied.
///
/// All faces are there: what is out of range, cut off or in words that nobody knows is refused.
/// Nothing else of a file is judged: normals, colours, textures, materials, cameras and lights cost
/// no file, whatever they hold.
///
/// glTF is read by assimp, in single precision: MeshFileContent::error bounds what that changes. A
/// small reader of ours (gltf_summary.hpp) counts the triangles first, and what assimp returns must
/// have as many and reach no farther. Our readers read all others, in double precision.
///
/// Assimp runs in a process of its own, for as long and with as much memory as a file of that size
/// can reasonably take: one that makes it crash or hang is refused as any other. That process reads
/// one file after the other, each within limits of its own, as long as it reads them whole; one
/// that failed at a file reads no other, and a file is refused only by one that has read no other.
/// With ImportPlace::Here it runs in this process, without limits.
///
/// No other file is opened, not even one that this file names (materials, textures, buffers).
/// Throws MeshFileError for another ending, a file over 256 MB, one with more than 20 million
/// triangles, one that cannot be read whole, or one without triangles, and where no process can be
/// made, and reads the next file nevertheless. One thread uses it, and outlives it.
class MeshFileReader {
 public:
  explicit MeshFileReader(ImportPlace place = ImportPlace::Child);
  /// With something else in place of assimp.
  explicit MeshFileReader(MeshImport import, ImportPlace place = ImportPlace::Child);

  MeshFileContent read(const std::filesystem::path& file);
  /// The same with the colours that a COLLADA file's materials have. What is wrong with these costs
  /// the colours, not the file.
  MeshFileContent readWithColours(const std::filesystem::path& file);

 private:
  MeshFileContent readAs(const std::filesystem::path& file, FaceMaterials materials);
  MeshFileContent import(const std::string& name, std::string_view text,
                         const MeshSummary& summary);
  MeshFileContent ask(const std::string& name, std::string_view text);
  /// All that `summary` says there is.
  MeshFileContent askForWhole(const std::string& name, std::string_view text,
                              const MeshSummary& summary);

  MeshImport import_;
  ImportPlace place_;
  ChildProcess child_;
};

}  // namespace swept::detail
