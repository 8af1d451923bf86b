// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace swept {

/// Bytes of another library's text that a message takes. What says why is at its beginning, and
/// some libraries put all the rest of a file behind it.
inline constexpr std::size_t kMaxForeignBytes = 300;

/// Another library's error, or a value of a file, as a message has it: one line of at most
/// kMaxForeignBytes bytes of `text` in whole characters, with `...` where more follows. Ends of
/// lines are `\n`, and other control characters `\u001b`, as JSON has them; so are bytes that are
/// no UTF-8, by their number. White space around it is left out.
std::string foreignText(std::string_view text);

}  // namespace swept
