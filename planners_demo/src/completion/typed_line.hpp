// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "command_line/arguments.hpp"

namespace swept {

/// The words of the beginning of a command line, without their quotes and backslashes; the last
/// is the one at its end, empty behind a blank.
std::vector<std::string> shellWords(std::string_view line);

/// The beginning of a command line of this program, as far as it says what may follow.
struct TypedLine {
  const CLI::App* app = nullptr;        ///< the innermost subcommand that is chosen
  const CLI::Option* option = nullptr;  ///< whose value is typed; null: none
  std::string before;                   ///< `--option=` where the value is in the same word
  std::string word;                     ///< the word, or the value, that is being typed
  std::size_t positionals = 0;          ///< words before it that belong to no option
  Arguments args;                       ///< robot, SRDF, group, problems, where they are there
};

/// `program`: see describeProgram(). `words`: of shellWords(), of which there are two or more.
TypedLine readTyped(const CLI::App& program, const std::vector<std::string>& words);

}  // namespace swept
