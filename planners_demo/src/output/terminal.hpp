// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

/// What is known of the place that text goes to.
namespace swept {

enum class Stream { Out, Err };

/// How long a line may be. Of stdout the environment's COLUMNS where it is a number above zero,
/// else the terminal's; none where there is no terminal, so that what reads a pipe finds one line
/// per row. Of stderr the terminal's alone: what reads messages from a pipe finds one line each. At
/// least 20.
std::optional<std::size_t> columnsOf(Stream stream);

/// It is a terminal, with a width, that shows colours, and the environment's NO_COLOR is not set,
/// or empty. TERM is set and not `dumb`.
bool isColoured(Stream stream);

}  // namespace swept
