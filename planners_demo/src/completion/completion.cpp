// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "command_line/commands.hpp"
#include "command_line/program_options.hpp"
#include "output/text_output.hpp"
#include "plan/planners.hpp"

namespace swept {
namespace {

struct Entry {
  std::string name;     ///< `bench edges`
  std::string summary;  ///< of the subcommand
  std::vector<std::string> options;
};

std::vector<Entry> entriesOf(const CLI::App& program) {
  std::vector<Entry> entries;
  for (const Command* command : commands()) {
    const CLI::App* app = &program;
    std::string rest(command->name);
    while (!rest.empty()) {
      const std::size_t blank = rest.find(' ');
      app = app->get_subcommand(rest.substr(0, blank));
      rest = blank == std::string::npos ? "" : rest.substr(blank + 1);
    }
    Entry entry{.name = std::string(command->name),
                .summary = std::string(command->summary),
                .options = {}};
    for (const CLI::Option* option : app->get_options()) {
      for (const std::string& name : option->get_lnames()) entry.options.push_back("--" + name);
      for (const std::string& name : option->get_snames()) entry.options.push_back("-" + name);
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

/// `plan bench`: the first words, or those behind `family`.
std::string wordsBehind(const std::vector<Entry>& entries, const std::string& family) {
  std::string words;
  for (const Entry& entry : entries) {
    if (!family.empty() && !entry.name.starts_with(family + " ")) continue;
    const std::string rest = family.empty() ? entry.name : entry.name.substr(family.size() + 1);
    const std::string word = rest.substr(0, rest.find(' '));
    if ((" " + words + " ").find(" " + word + " ") == std::string::npos)
      words += (words.empty() ? "" : " ") + word;
  }
  return words;
}

/// Also for zsh, which reads it with bashcompinit.
std::string bashScript(const std::vector<Entry>& entries) {
  std::string text =
      "_swept() {\n"
      "  local word=\"${COMP_WORDS[COMP_CWORD]}\" before=\"${COMP_WORDS[COMP_CWORD-1]}\"\n"
      "  local command=\"${COMP_WORDS[1]}\" words=\"\"\n"
      "  if [ \"$before\" = --planner ]; then\n"
      "    words=\"" +
      joined(plannerNames(), " ") +
      "\"\n"
      "  elif [ \"$COMP_CWORD\" = 1 ]; then\n"
      "    words=\"" +
      wordsBehind(entries, "") +
      " --help --version\"\n"
      "  else\n"
      "    case \"$command\" in\n"
      "      bench) [ \"$COMP_CWORD\" = 2 ] && words=\"" +
      wordsBehind(entries, "bench") +
      "\" || command=\"bench ${COMP_WORDS[2]}\" ;;\n"
      "    esac\n"
      "    case \"$command\" in\n";
  for (const Entry& entry : entries)
    text += "      \"" + entry.name + "\") words=\"" + joined(entry.options, " ") + "\" ;;\n";
  return text +
         "    esac\n"
         "  fi\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "}\n"
         "complete -o default -F _swept swept\n";
}

/// Between single quotes, as fish reads them.
std::string fishText(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted.append(c == '\'' || c == '\\' ? "\\" : "").append(1, c);
  return quoted + "'";
}

std::string fishScript(const std::vector<Entry>& entries) {
  std::string text;
  for (const Entry& entry : entries) {
    std::string seen;  // the words that come first, as conditions
    std::string rest = entry.name;
    for (std::size_t blank; (blank = rest.find(' ')) != std::string::npos;
         rest = rest.substr(blank + 1))
      seen += "; and __fish_seen_subcommand_from " + rest.substr(0, blank);
    const std::string first = entry.name.substr(0, entry.name.find(' '));
    text += "complete -c swept -n '" +
            (seen.empty() ? std::string("__fish_use_subcommand") : seen.substr(6)) + "' -a " +
            rest + " -d " + fishText(entry.summary) + "\n";
    if (!seen.empty()) text += "complete -c swept -n __fish_use_subcommand -a " + first + "\n";
    for (const std::string& option : entry.options) {
      const bool isLong = option.starts_with("--");
      text += "complete -c swept -n '" +
              (seen.empty() ? std::string() : seen.substr(6) + "; and ") +
              "__fish_seen_subcommand_from " + rest + "' " +
              (isLong ? "-l " + option.substr(2) : "-s " + option.substr(1)) +
              (option == "--planner" ? " -x -a '" + joined(plannerNames(), " ") + "'" : "") + "\n";
    }
  }
  return text;
}

}  // namespace

ExitCode runCompletion(const Arguments& args) {
  CLI::App program;
  Arguments unused;
  describeProgram(program, unused);
  const std::vector<Entry> entries = entriesOf(program);
  if (args.shell == "zsh") std::cout << "autoload -U +X bashcompinit && bashcompinit\n";
  std::cout << (args.shell == "fish" ? fishScript(entries) : bashScript(entries));
  return ExitCode::Free;
}

}  // namespace swept
