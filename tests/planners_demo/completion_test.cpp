// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "program.hpp"

namespace swept::test {
namespace {

/// The words of a line as fish reads it: between single quotes `\'` and `\\` stand for the second
/// character. None: a quote is not closed.
std::optional<std::vector<std::string>> fishWords(const std::string& line) {
  std::vector<std::string> words{""};
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool escape = line[i] == '\\' && i + 1 < line.size();
    if (quoted && escape && (line[i + 1] == '\'' || line[i + 1] == '\\'))
      words.back() += line[++i];
    else if (line[i] == '\'')
      quoted = !quoted;
    else if (line[i] == ' ' && !quoted)
      words.emplace_back();
    else
      words.back() += line[i];
  }
  if (quoted) return std::nullopt;
  return words;
}

/// The summary of `acm` has an apostrophe, which ended the text there.
TEST(Completion, FishReadsEachSummaryAsHelpHasIt) {
  std::istringstream lines(runSwept({"completion", "fish"}).out);
  int summaries = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto words = fishWords(line);
    ASSERT_TRUE(words) << line;
    const auto summary = std::ranges::find(*words, "-d");
    if (summary == words->end()) continue;
    ++summaries;
    ASSERT_EQ(words->end() - summary, 2) << line;
    std::vector<std::string> help{*(summary - 1), "--help"};
    const std::string condition = words->at(4), behind = "__fish_seen_subcommand_from ";
    if (condition.starts_with(behind)) help.insert(help.begin(), condition.substr(behind.size()));
    const std::string text = runSwept(help).out;
    EXPECT_EQ(text.substr(0, text.find('\n')), *(summary + 1)) << line;
  }
  EXPECT_GE(summaries, 11);
}

TEST(Completion, ShellsReadTheirScripts) {
  EXPECT_EQ(runShell("swept completion bash | bash -n").exitCode, 0);
  for (const std::string shell : {"zsh", "fish"}) {
    if (runShell("command -v " + shell).exitCode != 0) continue;
    EXPECT_EQ(runShell("swept completion " + shell + " | " + shell + " -n").exitCode, 0) << shell;
  }
}

}  // namespace
}  // namespace swept::test
