// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

/// Files that are written in one go or not at all.
namespace swept {

/// Throws UsageError when the file could not be written: better before the work than after it.
void requireWritable(const std::filesystem::path& file);

/// Whoever reads the file sees the old one or the whole new one, which has the old one's mode. A
/// link stays, and what it leads to is written; a pipe or a device just takes the bytes. Throws
/// UsageError. A signal that ends the program meanwhile (SIGINT, SIGTERM, SIGHUP) leaves the old
/// file and no other.
void writeWholeFile(const std::filesystem::path& file, const std::string& text);

/// Where links from `file` lead, which is where what is written to it goes; `file` itself without
/// one. Throws UsageError where they lead in a circle.
std::filesystem::path endOfLinks(const std::filesystem::path& file);

/// For handlers of signals that end the program by themselves: the file that is being written, if
/// any, is gone. Does only what a handler may.
void removeUnfinishedFile();

}  // namespace swept
