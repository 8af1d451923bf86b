// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace swept::detail {

inline constexpr std::string_view kNoSuchFile = "file not found";

/// Why a path is not that of a regular file, as messages say it; empty: it is one. Throws nothing
/// for errors of the file system: kNoSuchFile, a folder, symbolic links in a circle, a name that is
/// too long, a folder without permission.
std::string whyUnreadable(const std::filesystem::path& file);

/// The same for a reader that reads a file once from front to end, so a pipe, or a device such as
/// /dev/stdin, is fine.
std::string whyNoBytes(const std::filesystem::path& file);

}  // namespace swept::detail
