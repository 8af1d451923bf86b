// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "models_dir.hpp"
#include "program.hpp"

/// What the README shows is what the tree holds and the program prints.
namespace swept::test {
namespace {

std::string fileText(const std::string& name) {
  std::ifstream stream((modelsDir() + "/../") + name);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Contents of the README's fenced blocks of one language.
std::vector<std::string> blocks(const std::string& language) {
  const std::string text = fileText("README.md");
  std::vector<std::string> found;
  const std::string fence = "```" + language + "\n";
  for (auto at = text.find(fence); at != std::string::npos; at = text.find(fence, at)) {
    at += fence.size();
    found.push_back(text.substr(at, text.find("\n```", at) + 1 - at));
  }
  return found;
}

/// Numbers, and the blanks that align them, differ from run to run and compiler to compiler.
std::string withoutNumbers(std::string text) {
  text = std::regex_replace(text, std::regex("-?[0-9]+(\\.[0-9]+)?(e-?[0-9]+)?"), "N");
  return std::regex_replace(text, std::regex(" +"), " ");
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

TEST(Readme, ItsProgramIsTheExample) {
  ASSERT_EQ(blocks("cpp").size(), 1u);
  EXPECT_THAT(fileText("planners_demo/examples/07_plan.cpp"),
              testing::HasSubstr("\n" + blocks("cpp").front()));
}

TEST(Readme, ItsCommandsPrintWhatItShows) {
  const TemporaryFolder folder;
  ASSERT_GE(blocks("console").size(), 4u);
  for (const std::string& block : blocks("console")) {
    ASSERT_TRUE(block.starts_with("$ swept ")) << block;
    const auto end = block.find('\n');
    const std::string command =
        replaced(replaced(block.substr(2, end - 2), "path.json", folder.path("p.json")), "dumps",
                 folder.path("dumps"));
    const Outcome run = runShell(command);
    EXPECT_EQ(run.err, "") << command;
    EXPECT_EQ(withoutNumbers(replaced(run.out, folder.path("p.json"), "path.json")),
              withoutNumbers(block.substr(end + 1)))
        << command;
  }
}

}  // namespace
}  // namespace swept::test
