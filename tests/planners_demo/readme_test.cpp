// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "models_dir.hpp"
#include "printed_text.hpp"
#include "program.hpp"

/// What the README shows is what the tree holds and the program prints.
namespace swept::test {
namespace {

std::string ofTree(const std::string& name) {
  return fileText(modelsDir() + "/../" + name);
}

/// Contents of the README's fenced blocks of one language.
std::vector<std::string> blocks(const std::string& language) {
  const std::string text = ofTree("README.md");
  std::vector<std::string> found;
  const std::string fence = "```" + language + "\n";
  for (auto at = text.find(fence); at != std::string::npos; at = text.find(fence, at)) {
    at += fence.size();
    found.push_back(text.substr(at, text.find("\n```", at) + 1 - at));
  }
  return found;
}

/// What differs from machine to machine: times, and the three columns of `bench edges` that are
/// times without a unit of their own.
std::string withoutMeasurements(const std::string& text) {
  static const std::regex kRow(
      "(\n *([0-9.]+|all) +(free|collision|undecided|all) +[0-9]+)( +[0-9]+){3} ");
  return std::regex_replace(withoutTimes(text), kRow, "$1 # # # ");
}

TEST(Readme, ItsProgramIsTheExample) {
  ASSERT_EQ(blocks("cpp").size(), 1u);
  EXPECT_THAT(ofTree("planners_demo/examples/07_plan.cpp"),
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
    SCOPED_TRACE(command);
    EXPECT_EQ(run.err, "");
    expectPrinted(withoutMeasurements(replaced(run.out, folder.path("p.json"), "path.json")),
                  withoutMeasurements(block.substr(end + 1)));
  }
}

TEST(Readme, OnlyTimesAreLeftOutOfTheComparison) {
  EXPECT_EQ(withoutMeasurements("\n   0.1  all   6  1045  1058   1095    8.0  100.0 %"
                                "\n   all  free  6  1045  1058   1095    8.0  100.0 %"
                                "\nRRTConnect  0.005 s  2.81688  2  51  15  0.00122 m"),
            "\n   0.1  all   6 # # #    8.0  100.0 %"
            "\n   all  free  6 # # #    8.0  100.0 %"
            "\nRRTConnect  # s  2.81688  2  51  15  0.00122 m");
}

}  // namespace
}  // namespace swept::test
