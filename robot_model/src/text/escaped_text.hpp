// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

/// Names and values of files must not control a terminal. Control characters in them would move its
/// cursor, change its title or fake lines.
namespace swept {

/// One line: control characters become `\u001b`, as in JSON, and line ends `\n`. Tabs stay, and so
/// do bytes that are neither UTF-8 nor control characters of Latin-1.
std::string escapedLine(std::string_view text);
/// The same, but line ends stay.
std::string escapedText(std::string_view text);

}  // namespace swept
