// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "models_dir.hpp"

/// What the pages show is what is compiled, and what they say twice they say the same way.
namespace swept::test {
namespace {

std::vector<std::string> linesOf(const std::string& name) {
  std::ifstream stream((modelsDir() + "/../") + name);
  EXPECT_TRUE(stream) << name;
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Lines without what they are indented by: a page has no function around its code.
std::string withoutIndent(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines)
    text += line.substr(std::min(line.find_first_not_of(' '), line.size())) + '\n';
  return text;
}

std::vector<std::string> blocks(const std::string& page) {
  std::vector<std::string> found;
  std::vector<std::string> block;
  bool inside = false;
  for (const std::string& line : linesOf(page)) {
    if (inside && line == "```") {
      found.push_back(withoutIndent(block));
      inside = false;
    } else if (inside) {
      block.push_back(line);
    } else if (line == "```cpp") {
      block.clear();
      inside = true;
    }
  }
  EXPECT_FALSE(inside) << page;
  return found;
}

/// Rows of the table that begins with this cell, but for the line below its head.
std::vector<std::string> rows(const std::string& page, const std::string& head) {
  std::vector<std::string> found;
  for (const std::string& line : linesOf(page)) {
    if (found.empty() ? line.starts_with(head) : line.starts_with("| "))
      found.push_back(line);
    else if (!found.empty() && !line.starts_with("|"))
      break;
  }
  return found;
}

/// Whether a block is code from one empty line, or an opening brace, to another, or a closing one:
/// a block that lost its last statement is not.
bool showsAWholePart(const std::string& code, const std::string& block) {
  for (size_t at = code.find(block); at != std::string::npos; at = code.find(block, at + 1)) {
    const std::string_view before = std::string_view(code).substr(0, at);
    const std::string_view after = std::string_view(code).substr(at + block.size());
    if ((before.ends_with("\n\n") || before.ends_with("{\n")) &&
        (after.starts_with('\n') || after.starts_with('}')))
      return true;
  }
  return false;
}

TEST(Pages, ABlockThatLostItsEndIsNotAWholePart) {
  const std::string code = "void f() {\none();\ntwo();\n\nthree();\n}\n";
  EXPECT_TRUE(showsAWholePart(code, "one();\ntwo();\n"));
  EXPECT_TRUE(showsAWholePart(code, "three();\n"));
  EXPECT_FALSE(showsAWholePart(code, "one();\n"));
  EXPECT_FALSE(showsAWholePart(code, "two();\n"));
  EXPECT_FALSE(showsAWholePart(code, "four();\n"));
}

TEST(Pages, MigrationShowsWhatIsCompiled) {
  const std::string code = withoutIndent(linesOf("tests/docs/migration_test.cpp")) +
                           withoutIndent(linesOf("tests/docs/migration_fcl.cpp"));
  const std::vector<std::string> shown = blocks("ompl_bridge/migration.md");
  EXPECT_GE(shown.size(), 14u);
  for (const std::string& block : shown) EXPECT_TRUE(showsAWholePart(code, block)) << block;
}

TEST(Pages, TheReadmesTableIsPartOfTheComparison) {
  const std::vector<std::string> all = rows("tests/benchmark/comparison.md", "| | swept | FCL |");
  const std::vector<std::string> part = rows("README.md", "| | swept | FCL |");
  EXPECT_GE(all.size(), 20u);
  EXPECT_GE(part.size(), 8u);
  for (const std::string& row : part) EXPECT_THAT(all, testing::Contains(row));
}

}  // namespace
}  // namespace swept::test
