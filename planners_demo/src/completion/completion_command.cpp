// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"

namespace swept {
namespace {

void addCompletionOptions(CLI::App& app, Arguments& args) {
  app.add_option("shell", args.shell,
                 "bash, zsh or fish; or 'words': what may come at the end of LINE, a word per "
                 "line, as their "
                 "scripts ask")
      ->required()
      ->type_name("SHELL")
      ->check(CLI::Validator(
          [](std::string& shell) -> std::string {
            const bool known =
                shell == "bash" || shell == "zsh" || shell == "fish" || shell == "words";
            return known ? ""
                         : "must be bash, zsh, fish or words, not " + CLI::detail::trim_copy(shell);
          },
          ""));
  app.add_option("line", args.line, "beginning of a command line")->type_name("LINE");
}

}  // namespace

const Command kCompletionCommand{
    .name = "completion",
    .summary = "Completion of subcommands, options and the robot's names, as a script for a shell",
    .example = "swept completion bash > swept_completion.bash",
    .exitCodes = "Exit codes: 0 printed, 3 bad input or usage.",
    .addOptions = addCompletionOptions,
    .run = runCompletion};

}  // namespace swept
