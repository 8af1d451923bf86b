// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <set>

namespace swept::detail {

/// The files that this library reads while the object exists, on any thread: those that an answer
/// depends on. Names are absolute, without symbolic links but for the file's own name. One object
/// at a time.
class ReadFiles {
 public:
  ReadFiles();
  ~ReadFiles();
  ReadFiles(const ReadFiles&) = delete;
  ReadFiles& operator=(const ReadFiles&) = delete;

  std::set<std::filesystem::path> files() const;

  /// Called by whoever opens a file to read it. Does nothing without an object.
  static void note(const std::filesystem::path& file);
};

}  // namespace swept::detail
