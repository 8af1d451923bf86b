// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

/// Properties of the place that text goes to.
namespace swept {

enum class Stream { Out, Err };

/// The longest line, at least 20. For stdout: the environment's COLUMNS where it is a number above
/// zero, otherwise the terminal's width. None where there is no terminal, so that a reader of a
/// pipe finds one line per row. For stderr: the terminal's width alone, so that a reader of
/// messages from a pipe finds one line each.
/// least 20.
std::optional<std::size_t> columnsOf(Stream stream);

/// True for a terminal with a width if the environment's NO_COLOR is empty or not set, and TERM is
/// set and not `dumb`.
bool isColoured(Stream stream);

}  // namespace swept
