// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/input_source.hpp"
#include "io/mesh_file.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept::detail {

/// A mesh as an input file names it.
struct MeshReference {
  std::string reference;  ///< a path or package://, as in the file
  int line = 0;
  std::string owner;  ///< as in `link 'arm'`
};

/// Where the file of a reference is; else what kept it from being found, as messages go on after
/// its name.
struct MeshPlace {
  std::filesystem::path file;
  std::string problem;
};
MeshPlace placeOfMesh(const std::string& reference, const InputSource& source);

/// The meshes that one input file refers to: found, read, scaled and shared.
class MeshStore {
 public:
  explicit MeshStore(const InputSource& source) : source_(source) {}

  /// Throws one InputError that names all files that are not there, ten at the most and how many
  /// more.
  void requireFound(const std::vector<MeshReference>& references) const;

  /// The mesh that `reference` names, scaled per axis (negative mirrors). The same file at the same
  /// scale is one mesh. Cracks of up to 1e-5 of its size, or what rounding explains, are filled: a
  /// warning names those that rounding does not explain. `line` and
  /// `owner` (as in `link 'arm'`) go into the messages: an open surface is a warning, a mesh that
  /// cannot be used an InputError.
  TriangleMesh mesh(const std::string& reference, const Eigen::Vector3d& scale, int line,
                    const std::string& owner);

 private:
  using Key = std::pair<std::filesystem::path, std::array<double, 3>>;
  const InputSource& source_;
  MeshFileReader files_;
  std::map<Key, TriangleMesh> meshes_;
};

/// Warns when part of `mesh` does not enclose anything.
void warnIfOpen(const TriangleMesh& mesh, const std::string& name, int line,
                const InputSource& source);

}  // namespace swept::detail
