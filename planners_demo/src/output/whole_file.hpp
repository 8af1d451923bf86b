// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

/// Files that are written in one go or not at all.
namespace swept {

/// Throws UsageError when the file could not be written: better before the work than after it.
void requireWritable(const std::filesystem::path& file);

/// Whoever reads the file sees the old one or the whole new one. Throws UsageError.
void writeWholeFile(const std::filesystem::path& file, const std::string& text);

}  // namespace swept
