// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "command_line/arguments.hpp"
#include "command_line/exit_code.hpp"

namespace CLI {
class App;
}

namespace swept {

/// A subcommand. `run` prints results on stdout and throws InputError or UsageError.
struct Command {
  std::string_view name;       ///< `bench edges` for a subcommand of a subcommand
  std::string_view summary;    ///< one line
  std::string_view example;    ///< runs from the folder that holds `models`
  std::string_view exitCodes;  ///< what they mean
  void (*addOptions)(CLI::App& app, Arguments& args);
  ExitCode (*run)(const Arguments& args);
  std::string (*notes)() = nullptr;  ///< more text for the help, above the example; null: none
  bool takesLists = false;           ///< a STATE may be `@FILE`, `-` or a path file
  bool hasClock = false;             ///< objects of the scene may move
};

/// All subcommands, in the order of the help.
std::span<const Command* const> commands();

/// The exit codes of most subcommands.
inline constexpr std::string_view kVerdictExitCodes =
    "Exit codes: 0 free or solved, 1 collision or not solved, 2 undecided, 3 bad input or usage.";

/// How states are written on the command line.
std::string stateNotes();
/// The same, and the forms that stand for many states.
std::string stateListNotes();

}  // namespace swept
