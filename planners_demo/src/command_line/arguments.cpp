// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/arguments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

#include "command_line/command.hpp"
#include "command_line/program_options.hpp"
#include "command_line/shell_word.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/did_you_mean.hpp"

namespace swept {
namespace {

/// `-0.1,0.2` and `-inf` are values, not options.
bool isNegativeValue(const std::string& text) {
  if (text.size() < 2 || text[0] != '-') return false;
  return std::isdigit(static_cast<unsigned char>(text[1])) || text[1] == '.' ||
         text.starts_with("-inf") || text.starts_with("-nan");
}

/// The arguments, last first, as the parser wants them. A leading blank keeps it from taking a
/// negative value for an option, and everything that reads a value skips blanks. That leaves
/// nothing for a `--` to do, which the parser would turn against options that are limited in
/// number.
std::vector<std::string> reversedArguments(int argc, const char* const* argv) {
  std::vector<std::string> reversed;
  for (int i = argc - 1; i > 0; --i) {
    const std::string text = argv[i];
    if (text == "--") continue;
    reversed.push_back(isNegativeValue(text) ? " " + text : text);
  }
  return reversed;
}

/// Takes that blank away again, so that files say what was typed.
void restore(std::string& value) {
  if (value.starts_with(" -")) value.erase(0, 1);
}

/// The command line as it could be pasted into a shell.
std::string typedAgain(int argc, const char* const* argv) {
  std::string line = "swept";
  for (int i = 1; i < argc; ++i) line += " " + shellWord(argv[i]);
  return line;
}

std::string footerOf(const Command& command) {
  std::string text = "\n";
  if (command.notes != nullptr) text += command.notes() + "\n";
  return text + "Example:\n  " + std::string(command.example) + "\n\n" +
         std::string(command.exitCodes);
}

/// `bench` of `bench edges`; empty for `plan`.
std::string familyOf(std::string_view name) {
  const std::size_t blank = name.find(' ');
  return blank == std::string_view::npos ? "" : std::string(name.substr(0, blank));
}

/// `edges` of `bench edges`.
std::string lastWord(std::string_view name) {
  return std::string(name.substr(name.rfind(' ') + 1));
}

/// The app that a command hangs on, made when it is the first of its family.
CLI::App& parentOf(const Command& command, CLI::App& program) {
  const std::string family = familyOf(command.name);
  if (family.empty()) return program;
  const auto isFamily = [&](CLI::App* app) { return app->get_name() == family; };
  const std::vector<CLI::App*> found = program.get_subcommands(isFamily);
  if (!found.empty()) return *found.front();
  CLI::App* made = program.add_subcommand(
      family, family == "bench" ? "What checks and planners take and find on this machine"
                                : "Motions that stay proven while the world changes");
  made->require_subcommand(1);
  return *made;
}

std::vector<std::string> listIn(const std::string& family) {
  std::vector<std::string> names;
  for (const Command* command : commands()) {
    const std::string own = familyOf(command->name);
    const std::string name = own == family ? lastWord(command->name) : family.empty() ? own : "";
    if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

std::string namesIn(const std::string& family, const std::string& wanted) {
  const std::vector<std::string> names = listIn(family);
  return joined(names) + didYouMean(wanted, names);
}

/// For the first argument that looks like an option of the subcommand and is none.
std::string nearOption(const CLI::App& program, int argc, const char* const* argv) {
  const CLI::App* app = &program;
  int first = 1;
  while (first < argc) {
    const auto isIt = [&](const CLI::App* one) { return one->get_name() == argv[first]; };
    const auto chosen = app->get_subcommands(isIt);
    if (chosen.empty()) break;
    app = chosen.front();
    ++first;
  }
  std::vector<std::string> known;
  for (const CLI::Option* option : app->get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (int i = first; i < argc; ++i) {
    const std::string text = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    if (text.starts_with("--") && text != "--" && std::ranges::find(known, text) == known.end())
      return didYouMean(text, known);
  }
  return {};
}

/// The parser misses a subcommand before it says that it does not know the one given.
std::string messageOf(const CLI::ParseError& error, const CLI::App& program, int argc,
                      const char* const* argv) {
  const bool noSubcommand = std::string_view(error.what()).starts_with("A subcommand");
  if (!noSubcommand) return error.what() + nearOption(program, argc, argv);
  if (argc < 2) return "a subcommand is required; there are " + joined(listIn(""));
  const std::string family = argv[1];
  const bool known = std::ranges::any_of(
      commands(), [&](const Command* command) { return familyOf(command->name) == family; });
  if (!known) return "no subcommand '" + family + "'; there are " + namesIn("", family);
  return argc > 2 ? family + " has no subcommand '" + argv[2] + "'; there are " +
                        namesIn(family, argv[2])
                  : family + ": a subcommand is required; there are " + joined(listIn(family));
}

/// A shell makes an empty text of a variable that is not set. Taken for no option at all, it would
/// leave out the scene that something is to be proven in. Throws CLI::ValidationError.
void refuseEmptyValues(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    // Of several positionals, states, the message says what else each may be. A line that is to be
    // completed may be empty.
    if ((option->nonpositional() ||
         (option->get_items_expected_max() == 1 && option->get_name() != "line")) &&
        std::ranges::count(option->results(), "") > 0)
      throw CLI::ValidationError(option->get_name(), "must not be empty");
  for (const CLI::App* chosen : app.get_subcommands()) refuseEmptyValues(*chosen);
}

}  // namespace

void describeProgram(CLI::App& program, Arguments& args) {
  program.name("swept");
  program.description(
      "Validity of robot states and of whole motions, proven on the exact geometry.");
  program.require_subcommand(1);
  program.set_version_flag("--version", "swept " SWEPT_VERSION);
  program.footer("\n" + std::string(kVerdictExitCodes));
  for (const Command* command : commands()) {
    CLI::App* own = parentOf(*command, program)
                        .add_subcommand(lastWord(command->name), std::string(command->summary));
    command->addOptions(*own, args);
    own->footer(footerOf(*command));
    own->final_callback([&args, command] { args.command = command; });
  }
}

ParsedArguments parseArguments(int argc, const char* const* argv) {
  Arguments args;
  args.page.commandLine = typedAgain(argc, argv);
  CLI::App program;
  describeProgram(program, args);
  try {
    program.parse(reversedArguments(argc, argv));
    refuseEmptyValues(program);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      std::ostringstream help;
      const int code = program.exit(error, help, help);
      printText(help.str());
      return {.run = {}, .exitCode = code};
    }
    printMessage("swept: error: " + messageOf(error, program, argc, argv) + " (try --help)");
    return {.run = {}, .exitCode = static_cast<int>(ExitCode::BadInput)};
  }
  restore(args.cloudPose);
  for (std::string& state : args.states) restore(state);
  return {.run = std::move(args), .exitCode = 0};
}

}  // namespace swept
