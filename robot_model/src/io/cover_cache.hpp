// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "io/content_hash.hpp"
#include "swept/core/sphere_cover.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept::detail {

/// A folder of the covers of meshes. The name of each file is the hash of its inputs: the mesh, the
/// fineness, the version of the builder, the byte order.
///
/// A file is valid if its head and length are right and its end is the hash of the rest. Any other
/// file counts as missing. So files that are cut off, damaged or of another version cost time and
/// nothing else. Whoever can write to the folder can make a valid file, and a proof is only as good
/// as its covers. Therefore the folder and its files must belong to this user, and nobody else may
/// write to them; a missing folder is made so. Files appear whole under their names, so several
/// processes may share a folder. Any thread.
class CoverCache {
 public:
  /// Of LoadOptions::cache; empty: keeps nothing.
  explicit CoverCache(const std::filesystem::path& folder);

  /// The cover of the mesh from the folder, otherwise a new one, which is added to the folder.
  std::shared_ptr<const SphereCover> coverOf(const TriangleMesh& mesh);

  /// Why the folder is not used, or a cover could not be stored; empty: no problem.
  std::string problem() const;

 private:
  std::shared_ptr<const SphereCover> read(const ContentHash::Digest& key) const;
  void write(const ContentHash::Digest& key, const SphereCover& cover);
  std::filesystem::path fileOf(const ContentHash::Digest& key) const;

  std::filesystem::path folder_;  ///< empty: none is used
  mutable std::mutex mutex_;
  std::string problem_;
};

}  // namespace swept::detail
