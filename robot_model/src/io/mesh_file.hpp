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

/// Makes a mesh from a file's bytes; the name tells the format. Throws MeshFileError and
/// std::bad_alloc.
using MeshImport =
    std::function<MeshFileContent(const std::string& name, std::span<const std::uint8_t> bytes)>;

/// Where assimp runs.
enum class ImportPlace { Child, Here };

inline ImportPlace importPlaceOf(const LoadOptions& options) {
  return options.childProcess ? ImportPlace::Child : ImportPlace::Here;
}

/// Reads .stl, .obj, .dae, .ply, .off, .gltf and .glb, in letters of any size. Polygons are
/// triangulated (FaceCutter), points and lines dropped, node transforms applied.
///
/// The reader returns all faces. It refuses a file in which something is out of range, cut off or
/// unknown. It judges nothing else: no normals, colours, textures, materials, cameras or lights
/// make it refuse a file.
///
/// Assimp reads glTF, in single precision: MeshFileContent::error bounds what that changes. A small
/// reader of ours (gltf_summary.hpp) counts the triangles first. Assimp's result must have as many
/// and reach no farther. Our readers read all other formats, in double precision.
///
/// Assimp runs in a process of its own, for as long and with as much memory as a file of that size
/// can reasonably take. A file that makes it crash or hang is refused like any other bad file. That
/// process reads one file after the other, each within its own limits. After a failure it reads no
/// other file, and a file is refused only by a process that has read no other. With
/// ImportPlace::Here assimp runs in this process, without limits.
///
/// No other file is opened, not even one that this file names (materials, textures, buffers).
/// Throws MeshFileError for another ending, a file over 256 MB, more than 20 million triangles, a
/// file that cannot be read whole, and one without triangles. Throws it as well where no process
/// can be made, and can read the next file nevertheless. Use from one thread, which must outlive
/// it.
class MeshFileReader {
 public:
  explicit MeshFileReader(ImportPlace place = ImportPlace::Child);
  /// With something else in place of assimp.
  explicit MeshFileReader(MeshImport import, ImportPlace place = ImportPlace::Child);

  MeshFileContent read(const std::filesystem::path& file);
  /// The same with the colours of a COLLADA file's materials. A problem with these drops the
  /// colours, not the file.
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
