// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace swept {

/// Larger text files (URDF, SRDF, scenes, requests, problems, paths) are refused.
inline constexpr std::size_t kMaxTextBytes = std::size_t{64} << 20;

/// Largest nesting of JSON objects and arrays. Printing them recurses, and the stack is finite.
/// (The readers of XML and YAML have their own limit.)
inline constexpr int kMaxNesting = 500;

/// Largest number of keys in a JSON object. If their order is kept, each key is searched among
/// those before it.
inline constexpr std::size_t kMaxKeys = 20'000;

/// The whole file, or all data from a pipe or a device such as /dev/stdin. Throws InputError (line
/// 0) if it is neither, cannot be read, or has more than kMaxTextBytes.
std::string readTextFile(const std::filesystem::path& file);

/// Throws InputError with the line of the first `{` or `[` outside of strings that is nested deeper
/// than kMaxNesting, or of the first key beyond kMaxKeys in an object. The message names `file`;
/// `firstLine` is the number of the text's first line.
void requireModestJson(std::string_view text, const std::string& file, int firstLine = 1);

}  // namespace swept
