// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

/// Files that are written in one go or not at all.
namespace swept {

/// Throws UsageError when the file could not be written, also because its name is too long: better
/// before the work than after it.
void requireWritable(const std::filesystem::path& file);

/// Whoever reads the file sees the old one or the whole new one, which has the old one's mode. A
/// link stays, and what it leads to is written; a pipe or a device just takes the bytes. Throws
/// UsageError. A signal that ends the program meanwhile (SIGINT, SIGTERM, SIGHUP) leaves the old
/// file and no other.
void writeWholeFile(const std::filesystem::path& file, const std::string& text);

/// Where links from `file` lead, which is where what is written to it goes; `file` itself without
/// one. Throws UsageError where they lead in a circle.
std::filesystem::path endOfLinks(const std::filesystem::path& file);

/// A new file that is gone unless it is kept: also after a signal that ends the program (SIGINT,
/// SIGTERM, SIGHUP). Of more than 16 at the same time, those beyond stay after a signal.
class UnfinishedFile {
 public:
  /// `pattern` has XXXXXX before its last `ending` characters, which become those of a name that
  /// is not taken. Without such a file the descriptor is -1, and errno says why.
  UnfinishedFile(const std::string& pattern, int ending);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  int descriptor() const { return descriptor_; }
  const std::string& name() const { return name_; }
  /// Closes the descriptor. Returns -1 when that fails, with errno.
  int close();
  /// It stays, or has another name.
  void keep();

 private:
  bool hasSlot() const;
  std::string name_;
  int descriptor_ = -1;
  std::ptrdiff_t slot_ = PTRDIFF_MAX;  ///< where handlers of signals find the name
};

/// For handlers of signals that end the program by themselves: what is unfinished is gone. Does
/// only what a handler may.
void removeUnfinishedFiles();

}  // namespace swept
