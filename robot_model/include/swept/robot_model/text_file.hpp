// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace swept {

/// Larger files of text (URDF, SRDF, scenes, requests, problems, paths) are refused.
inline constexpr std::size_t kMaxTextBytes = std::size_t{64} << 20;

/// Objects and arrays of JSON may contain each other so deep: what prints them goes down with them,
/// on a stack that ends. (The readers of XML and YAML have a limit of their own.)
inline constexpr int kMaxNesting = 500;

/// Keys that an object of JSON may have. Where their order is kept, each of them is looked up among
/// those before it.
inline constexpr std::size_t kMaxKeys = 20'000;

/// The whole file, or all that comes out of a pipe or a device such as /dev/stdin. Throws
/// InputError (line 0) when it is neither, cannot be read, or has more than kMaxTextBytes.
std::string readTextFile(const std::filesystem::path& file);

/// Throws InputError with the line of the first `{` or `[` outside of strings that is nested deeper
/// than kMaxNesting, or of the first key that is one of more than kMaxKeys in an object; `file` is
/// named in it, and `firstLine` the number of the text's first line.
void requireModestJson(std::string_view text, const std::string& file, int firstLine = 1);

}  // namespace swept
