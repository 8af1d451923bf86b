// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/input_source.hpp"
#include "io/made_mesh.hpp"
#include "io/mesh_file.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept::detail {

/// A mesh as an input file names it.
struct MeshReference {
  std::string reference;  ///< a path or package://, as in the file
  int line = 0;
  std::string owner;                                ///< as in `link 'arm'`
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< per axis; negative: mirrored
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
  explicit MeshStore(const InputSource& source)
      : source_(source), files_(importPlaceOf(source.options())) {}

  /// Throws one InputError that names all files that are not there, ten at the most and how many
  /// more.
  void requireFound(const std::vector<MeshReference>& references) const;

  /// Makes these, with their covers, on all processors, and tells LoadOptions::progress. Those that
  /// follow a file that cannot be read are left out. What is wrong or remarkable get() says, of
  /// each when its turn comes, so that no message depends on the order in which they are done.
  void prepare(const std::vector<MeshReference>& references);

  /// The mesh that is named; unless it was prepared it is made now, without a cover. The same file
  /// at the same scale is one mesh. Cracks of up to 1e-5 of its size, or what rounding explains,
  /// are filled: a warning names those that rounding does not explain. Line and owner go into the
  /// messages: an open surface is a warning, a mesh that cannot be used an InputError.
  const MadeMesh& get(const MeshReference& mesh);

 private:
  using Key = std::pair<std::filesystem::path, std::array<double, 3>>;
  static Key keyOf(const std::filesystem::path& file, const Eigen::Vector3d& scale);
  /// One for each mesh that is not made yet. Files of the same content are one mesh, too.
  std::vector<Key> newOnes(const std::vector<MeshReference>& references);
  MadeMesh readNow(const std::filesystem::path& file, const Eigen::Vector3d& scale);

  const InputSource& source_;
  MeshFileReader files_;
  std::map<Key, MadeMesh> made_;
  std::map<Key, Key> copyOf_;  ///< of files: another one with the same content
  std::set<Key> told_;         ///< warned of
};

/// Warns when part of `mesh` does not enclose anything.
void warnIfOpen(const TriangleMesh& mesh, const std::string& name, int line,
                const InputSource& source);
/// The same, of a mesh with this report and `opening` (m, TriangleMesh::opening()).
void warnIfOpen(const MeshReport& report, double opening, const std::string& name, int line,
                const InputSource& source);

}  // namespace swept::detail
