// SPDX-License-Identifier: BSD-3-Clause
#include "io/cover_cache.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>
#include <utility>

#include "io/cover_bytes.hpp"
#include "robot/shape_cover.hpp"

namespace swept::detail {

namespace {

/// Increase it whenever covers are built differently or written in another form.
constexpr std::string_view kVersion = "swept cover 1\n";
/// Distinguishes machines with another order of bytes.
constexpr std::uint64_t kOrderOfBytes = 0x0102030405060708;

/// Ahead of the cover: what is written, how, of what, and how many bytes the cover has.
std::string headOf(const ContentHash::Digest& key, std::uint64_t size) {
  std::string head(kVersion);
  head.append(reinterpret_cast<const char*>(&kOrderOfBytes), sizeof kOrderOfBytes);
  head.append(reinterpret_cast<const char*>(key.data()), key.size());
  head.append(reinterpret_cast<const char*>(&size), sizeof size);
  return head;
}

ContentHash::Digest keyOf(const TriangleMesh& mesh) {
  ContentHash hash;
  hash.add(kVersion);
  const std::array<double, 2> fineness{kCoverOverhang, kCoverRelative};
  const std::array<std::uint64_t, 7> counts{
      kOrderOfBytes,
      static_cast<std::uint64_t>(kMostInnerBalls),
      mesh.vertices().size(),
      mesh.triangles().size(),
      static_cast<std::uint64_t>(mesh.interior()),
      static_cast<std::uint64_t>(mesh.report().closedComponents),
      static_cast<std::uint64_t>(mesh.report().openComponents)};
  hash.addItems(std::span<const double>(fineness));
  hash.addItems(std::span<const std::uint64_t>(counts));
  hash.addItems(std::span<const Eigen::Vector3d>(mesh.vertices()));
  hash.addItems(std::span<const Eigen::Vector3i>(mesh.triangles()));
  return hash.digest();
}

/// The folder belongs to this user, and nobody else may write to it.
bool isOwn(const struct stat& info) {
  return info.st_uid == geteuid() && (info.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

/// Empty: the folder can be used.
std::string whyUnusable(const std::filesystem::path& folder) {
  if (mkdir(folder.c_str(), S_IRWXU) != 0 && errno != EEXIST)
    return std::string("it cannot be made: ") + std::strerror(errno);
  struct stat info {};
  if (stat(folder.c_str(), &info) != 0) return std::strerror(errno);
  if (!S_ISDIR(info.st_mode)) return "it is no folder";
  if (!isOwn(info)) return "it must belong to this user, and nobody else may write to it";
  return {};
}

/// Closed at the end.
class OpenFile {
 public:
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
  ~OpenFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  explicit operator bool() const { return descriptor_ >= 0; }

  /// The bytes of a file of this user's; empty: the file is someone else's, or cannot be read.
  std::optional<std::string> whole() const {
    struct stat info {};
    if (fstat(descriptor_, &info) != 0 || !S_ISREG(info.st_mode) || !isOwn(info)) return {};
    std::string bytes(static_cast<std::size_t>(info.st_size), '\0');
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t count = ::read(descriptor_, bytes.data() + done, bytes.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return {};
      done += static_cast<std::size_t>(count);
    }
    return bytes;
  }

  bool writeAll(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
  }

 private:
  int descriptor_;
};

/// What a file holds between its head and its hash; empty: the file is not valid.
std::optional<std::string_view> believed(std::string_view bytes, const ContentHash::Digest& key) {
  const std::size_t headSize = headOf(key, 0).size();
  const std::size_t frame = headSize + sizeof(ContentHash::Digest);
  if (bytes.size() < frame) return {};
  const std::size_t size = bytes.size() - frame;
  if (!bytes.starts_with(headOf(key, size))) return {};
  const ContentHash::Digest digest = hashOf(bytes.substr(0, headSize + size));
  if (std::memcmp(bytes.data() + headSize + size, digest.data(), digest.size()) != 0) return {};
  return bytes.substr(headSize, size);
}

}  // namespace

CoverCache::CoverCache(const std::filesystem::path& folder) : folder_(folder) {
  if (folder_.empty()) return;
  const std::string why = whyUnusable(folder_);
  if (why.empty()) return;
  problem_ = "the cache is not used: " + why;
  folder_.clear();
}

std::shared_ptr<const SphereCover> CoverCache::coverOf(const TriangleMesh& mesh) {
  if (folder_.empty()) return detail::coverOf(mesh);
  const ContentHash::Digest key = keyOf(mesh);
  if (auto kept = read(key)) return kept;
  auto cover = detail::coverOf(mesh);
  write(key, *cover);
  return cover;
}

std::string CoverCache::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

std::filesystem::path CoverCache::fileOf(const ContentHash::Digest& key) const {
  return folder_ / (hexadecimal(key) + ".cover");
}

std::shared_ptr<const SphereCover> CoverCache::read(const ContentHash::Digest& key) const {
  const OpenFile file(open(fileOf(key).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  if (!file) return nullptr;
  const std::optional<std::string> bytes = file.whole();
  if (!bytes) return nullptr;
  const std::optional<std::string_view> content = believed(*bytes, key);
  if (!content) return nullptr;
  std::optional<SphereCover> cover = coverFromBytes(*content);
  if (!cover) return nullptr;
  return std::make_shared<const SphereCover>(std::move(*cover));
}

void CoverCache::write(const ContentHash::Digest& key, const SphereCover& cover) {
  const std::string content = toBytes(cover);
  std::string bytes = headOf(key, content.size()) + content;
  const ContentHash::Digest digest = hashOf(bytes);
  bytes.append(reinterpret_cast<const char*>(digest.data()), digest.size());
  std::string unfinished = (folder_ / ".unfinished-XXXXXX").string();
  const OpenFile file(mkostemp(unfinished.data(), O_CLOEXEC));
  const bool isWritten =
      file && file.writeAll(bytes) && rename(unfinished.c_str(), fileOf(key).c_str()) == 0;
  if (isWritten) return;
  const int error = errno;
  if (file) unlink(unfinished.c_str());
  const std::lock_guard lock(mutex_);
  problem_ = std::string("a cover could not be put into the cache: ") + std::strerror(error);
}

}  // namespace swept::detail
