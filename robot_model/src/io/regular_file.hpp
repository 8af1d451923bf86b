// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace swept::detail {

inline constexpr std::string_view kNoSuchFile = "file not found";

/// What keeps a path from being that of a file with bytes to read, as messages say it; empty:
/// nothing does. Throws nothing of what the file system says: kNoSuchFile, a folder, links that
/// lead in a circle, a name that is too long, a folder that may not be looked into.
std::string whyUnreadable(const std::filesystem::path& file);

/// The same for who reads a file once, from its front to its end: a pipe, or a device such as
/// /dev/stdin, will do.
std::string whyNoBytes(const std::filesystem::path& file);

}  // namespace swept::detail
