// SPDX-License-Identifier: BSD-3-Clause
#include "io/read_files.hpp"

#include <atomic>
#include <mutex>
#include <utility>

namespace swept::detail {

namespace {

struct Noted {
  std::atomic<bool> wanted = false;
  std::mutex mutex;  ///< guards what follows
  std::set<std::filesystem::path> files;
};

Noted& noted() {
  static Noted all;
  return all;
}

}  // namespace

ReadFiles::ReadFiles() {
  const std::lock_guard lock(noted().mutex);
  noted().files.clear();
  noted().wanted = true;
}

ReadFiles::~ReadFiles() {
  noted().wanted = false;
}

std::set<std::filesystem::path> ReadFiles::files() const {
  const std::lock_guard lock(noted().mutex);
  return noted().files;
}

void ReadFiles::note(const std::filesystem::path& file) {
  if (!noted().wanted) return;
  namespace fs = std::filesystem;
  const fs::path whole = fs::absolute(file);
  fs::path name = fs::weakly_canonical(whole.parent_path()) / whole.filename();
  const std::lock_guard lock(noted().mutex);
  noted().files.insert(std::move(name));
}

}  // namespace swept::detail
