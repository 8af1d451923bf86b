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

/// Covers of meshes in a folder, each in a file whose name is the hash of all that it is made of:
/// the mesh, how fine it is to be, the version of what is made, the order of bytes.
///
/// Believed is a file with the right head and length whose end is the hash of the rest; any other
/// is as none. So files that are cut off, damaged or of another version cost time and nothing else.
/// Whoever can write to the folder can make a file that is believed, and a proof is as good as its
/// covers. Therefore it has to belong to this user and let nobody else write, and so do its files;
/// one that is not there is made so. Files appear whole, under their names, so several processes
/// may share a folder. Any thread.
class CoverCache {
 public:
  /// Of LoadOptions::cache; empty: keeps nothing.
  explicit CoverCache(const std::filesystem::path& folder);

  /// That of the folder, else a new one, which the folder gets.
  std::shared_ptr<const SphereCover> coverOf(const TriangleMesh& mesh);

  /// Why the folder is not used, or a cover could not be put there; empty: nothing is wrong.
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
