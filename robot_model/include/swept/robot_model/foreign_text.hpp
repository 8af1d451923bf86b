// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace swept {

/// Bytes of another library's text that a message quotes. The reason is at the beginning; some
/// libraries append the rest of a file.
inline constexpr std::size_t kMaxForeignBytes = 300;

/// Another library's error, or a value in a file, for use in a message: one line of at most
/// kMaxForeignBytes bytes of `text` in whole characters, with `...` if more follows. Line ends
/// become `\n`, other control characters `\u001b`, as in JSON, and bytes that are not UTF-8
/// likewise by their number. Surrounding white space is removed.
std::string foreignText(std::string_view text);

}  // namespace swept
