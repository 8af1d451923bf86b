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

/// The path of a reference's file, or why it was not found, as messages go on after its name.
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

  /// Throws one InputError that names all missing files: at most ten, and how many more.
  void requireFound(const std::vector<MeshReference>& references) const;

  /// Makes these meshes, with their covers, on all processors, and reports to
  /// LoadOptions::progress. Leaves out those after a file that cannot be read. get() gives the
  /// errors and warnings of each mesh when its turn comes, so that no message depends on the order
  /// in which the meshes are made.
  void prepare(const std::vector<MeshReference>& references);

  /// The mesh of a reference; unless it was prepared it is made now, without a cover. The same file
  /// at the same scale is one mesh. Cracks are filled up to 1e-5 of the mesh's size, or up to what
  /// rounding explains; a warning names those that rounding does not explain. Line and owner go
  /// into the messages. An open surface is a warning, a mesh that cannot be used an InputError.
  const MadeMesh& get(const MeshReference& mesh);

 private:
  using Key = std::pair<std::filesystem::path, std::array<double, 3>>;
  static Key keyOf(const std::filesystem::path& file, const Eigen::Vector3d& scale);
  /// One for each mesh that is not made yet. Files with the same content are one mesh, too.
  std::vector<Key> newOnes(const std::vector<MeshReference>& references);
  MadeMesh readNow(const std::filesystem::path& file, const Eigen::Vector3d& scale);

  const InputSource& source_;
  MeshFileReader files_;
  std::map<Key, MadeMesh> made_;
  std::map<Key, Key> copyOf_;  ///< of files: another one with the same content
  std::set<Key> told_;         ///< warned of
};

/// Warns when part of `mesh` encloses nothing.
void warnIfOpen(const TriangleMesh& mesh, const std::string& name, int line,
                const InputSource& source);
/// The same, for a mesh with this report and `opening` (m, TriangleMesh::opening()).
void warnIfOpen(const MeshReport& report, double opening, const std::string& name, int line,
                const InputSource& source);

}  // namespace swept::detail
