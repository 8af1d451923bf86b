// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Lines that fit a terminal.
namespace swept {

/// The columns that a text takes: one for each character of its UTF-8, none for the marks of
/// painted().
std::size_t widthOf(std::string_view text);

/// The text in lines of at most `columns`, broken at blanks and, with `atCommas`, after commas.
/// Longer words stay whole, and so does a number with its unit. An empty text gives one line.
std::vector<std::string> brokenCell(std::string_view text, std::size_t columns, bool atCommas);

/// The lines of `text`, each broken at blanks where it is longer than `columns`. Continuation lines
/// are set under the last part of the line that follows two blanks or more, otherwise two blanks
/// further in. Longer words stay whole, and so does a number with its unit. A command (`swept ...`)
/// is broken outside of quotes only, with a backslash, so a shell reads the same command.
std::string brokenLines(std::string_view text, std::size_t columns);

}  // namespace swept
