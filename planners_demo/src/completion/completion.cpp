// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "command_line/commands.hpp"
#include "command_line/exit_code.hpp"
#include "command_line/program_options.hpp"
#include "completion/candidates.hpp"

namespace swept {
namespace {

/// The program itself knows what may follow. Bash takes what stands behind one of `=`, `:` and `@`
/// for a word of its own, unless told otherwise, so that what is in front of it has to go.
constexpr const char* kBashScript = R"sh(_swept() {
  local line="${COMP_LINE:0:COMP_POINT}" breaks="" letter kept="" IFS=$'\n'
  local word="${line##*[[:blank:]]}"
  COMPREPLY=($("$1" completion words "$line" 2>/dev/null))
  for letter in = : @; do
    case "$COMP_WORDBREAKS" in *"$letter"*) breaks+="$letter" ;; esac
  done
  if [ -n "$breaks" ]; then kept="${word%"${word##*[$breaks]}"}"; fi
  case "${COMPREPLY[0]}" in *[,=:]) compopt -o nospace 2>/dev/null ;; esac
  COMPREPLY=("${COMPREPLY[@]#"$kept"}")
}
complete -o default -F _swept swept
)sh";

constexpr const char* kZshScript = R"sh(_swept() {
  local -a found open
  found=(${(f)"$(${words[1]} completion words "${(j: :)words[1,CURRENT-1]} $PREFIX" 2>/dev/null)"})
  open=(${(M)found:#*[,=:]})
  found=(${found:|open})
  if (( $#found + $#open == 0 )); then _files; return; fi
  if (( $#found )); then compadd -a found; fi
  if (( $#open )); then compadd -S '' -a open; fi
}
if (( ! $+functions[compdef] )); then autoload -Uz compinit && compinit; fi
compdef _swept swept
)sh";

/// Between single quotes, as fish reads them.
std::string fishText(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted.append(c == '\'' || c == '\\' ? "\\" : "").append(1, c);
  return quoted + "'";
}

/// Subcommands with what they do, and the rest from the program itself: fish shows what it is told
/// last of a word that it is told twice.
std::string fishScript() {
  std::string text =
      "complete -c swept -a '(swept completion words (commandline -cp) 2>/dev/null)'\n";
  for (const Command* command : commands()) {
    const std::string name(command->name);
    const std::size_t blank = name.find(' ');
    const std::string condition = blank == std::string::npos
                                      ? std::string("__fish_use_subcommand")
                                      : "__fish_seen_subcommand_from " + name.substr(0, blank);
    text += "complete -c swept -n '" + condition + "' -a " +
            (blank == std::string::npos ? name : name.substr(blank + 1)) + " -d " +
            fishText(std::string(command->summary)) + "\n";
  }
  return text;
}

}  // namespace

ExitCode runCompletion(const Arguments& args) {
  if (args.shell == "words") {
    for (const std::string& word : candidatesFor(args.line)) std::cout << word << '\n';
    return ExitCode::Free;
  }
  if (!args.line.empty())
    throw UsageError("completion " + args.shell + ": a line is for 'completion words'");
  std::cout << (args.shell == "fish"  ? fishScript()
                : args.shell == "zsh" ? kZshScript
                                      : kBashScript);
  return ExitCode::Free;
}

}  // namespace swept
