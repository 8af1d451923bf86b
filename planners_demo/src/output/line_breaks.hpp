// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Lines that fit a terminal.
namespace swept {

/// Columns that a text takes: one for each character of its UTF-8, none for the marks of
/// painted().
std::size_t widthOf(std::string_view text);

/// The text in lines of at most `columns`, broken at blanks and, with `atCommas`, behind commas.
/// Words that are longer stay whole, and so does a number with its unit. One line of an empty text.
std::vector<std::string> brokenCell(std::string_view text, std::size_t columns, bool atCommas);

/// The lines of `text`, each broken at blanks where it is longer than `columns`. What follows is
/// set under the last part of the line that two blanks or more stand before, else two blanks
/// further in. Words that are longer than a line stay whole, and so does a number with its unit. A
/// command (`swept ...`) is broken outside of quotes only, with a backslash: a shell reads it as it
/// was.
std::string brokenLines(std::string_view text, std::size_t columns);

}  // namespace swept
