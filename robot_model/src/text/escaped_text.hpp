// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

/// What names and values of files may say to a terminal: nothing. Control characters of theirs
/// would move its cursor, change its title or make up lines.
namespace swept {

/// One line: control characters are `\u001b`, as JSON has them, and ends of lines `\n`. Tabs, and
/// bytes that are not UTF-8 and no control characters of Latin-1 either, stay.
std::string escapedLine(std::string_view text);
/// The same, but ends of lines stay.
std::string escapedText(std::string_view text);

}  // namespace swept
