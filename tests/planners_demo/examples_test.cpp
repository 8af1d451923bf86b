// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>

#include "models_dir.hpp"
#include "program.hpp"

/// What every --help shows can be typed as it is.
namespace swept::test {
namespace {

using testing::HasSubstr;

/// First words of the lines below `Subcommands:`.
std::vector<std::string> subcommands(const std::vector<std::string>& of) {
  std::vector<std::string> arguments = of;
  arguments.emplace_back("--help");
  const std::string help = runSwept(arguments).out;
  const std::size_t list = help.find("\nSubcommands:\n");
  std::vector<std::string> names;
  if (list == std::string::npos) return names;
  std::istringstream lines(help.substr(list + 14));
  for (std::string line; std::getline(lines, line) && line.starts_with("  ");) {
    // What follows a name that is too long for its column starts far to the right.
    std::istringstream words(line);
    std::string name;
    if (line[2] != ' ' && words >> name) names.push_back(name);
  }
  return names;
}

/// `bench edges` as two words.
std::vector<std::vector<std::string>> allCommands() {
  std::vector<std::vector<std::string>> commands;
  for (const std::string& name : subcommands({})) {
    const std::vector<std::string> inner = subcommands({name});
    if (inner.empty()) commands.push_back({name});
    for (const std::string& second : inner) commands.push_back({name, second});
  }
  return commands;
}

class Examples : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(Examples, RunAsTheyStand) {
  std::vector<std::string> arguments = GetParam();
  arguments.emplace_back("--help");
  const Outcome help = runSwept(arguments);
  EXPECT_EQ(help.exitCode, 0);
  EXPECT_EQ(help.err, "");
  EXPECT_THAT(help.out, HasSubstr("\nExit codes: 0 "));
  const std::size_t begin = help.out.find("\nExample:\n  ");
  ASSERT_NE(begin, std::string::npos);
  const std::string example =
      help.out.substr(begin + 12, help.out.find('\n', begin + 12) - begin - 12);
  EXPECT_THAT(example, HasSubstr("swept " + GetParam().front()));
  const TemporaryFolder folder;
  std::filesystem::create_directory_symlink(modelsDir(), folder.path("models"));
  const Outcome run = runCommands(example, folder.path());
  // That motion collides; the others' answers are good news.
  EXPECT_EQ(run.exitCode, GetParam().front() == "motion" ? 1 : 0) << example << "\n" << run.out;
  EXPECT_EQ(run.err, "") << example;
  EXPECT_EQ(run.out.find('\x1b'), std::string::npos) << "no colours in a pipe";
  EXPECT_GE(run.out.size() + folder.names().size(), 2u) << "something comes of it";
}

INSTANTIATE_TEST_SUITE_P(Help, Examples, testing::ValuesIn(allCommands()));

TEST(Completion, KnowsAllSubcommandsAndOptions) {
  const std::string fish = runSwept({"completion", "fish"}).out;
  EXPECT_GE(allCommands().size(), 9u);
  for (const std::vector<std::string>& command : allCommands()) {
    std::string line = "swept";
    for (const std::string& word : command) line += " " + word;
    EXPECT_THAT("\n" + runSwept({"completion", "words", line}).out,
                HasSubstr("\n" + command.back() + "\n"));
    // The long options of the help, each at the beginning of its line.
    std::vector<std::string> words = command;
    words.emplace_back("--help");
    const std::string help = runSwept(words).out;
    const std::string options = "\n" + runSwept({"completion", "words", line + " --"}).out;
    static const std::regex kOption("\n  (?:-.,)?(--[a-z-]+)");
    for (std::sregex_iterator it(help.begin(), help.end(), kOption), end; it != end; ++it)
      EXPECT_THAT(options, HasSubstr("\n" + it->str(1) + "\n")) << line;
    EXPECT_THAT(fish, HasSubstr(" -a " + command.back() + " -d '"));
  }
  EXPECT_EQ(runSwept({"completion", "csh"}).err,
            "swept: error: shell: must be bash, zsh, fish or words, not csh (try --help)\n");
  EXPECT_EQ(runSwept({"completion", "zsh", "swept"}).err,
            "swept: error: completion zsh: a line is for 'completion words'\n");
}

}  // namespace
}  // namespace swept::test
