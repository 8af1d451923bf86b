// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "models_dir.hpp"
#include "page_data.hpp"
#include "printed_text.hpp"
#include "program.hpp"

/// What commands print is what the files in golden/ hold: the command in the first line, its exit
/// code, stdout and stderr. `DIR` stands for an empty folder and `#` for any number; other numbers
/// agree to a thousandth, since another instruction set may order sums in another way.
/// SWEPT_UPDATE_GOLDEN=1 writes the files anew from their first lines.
namespace swept::test {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(modelsDir()).parent_path() / "tests/planners_demo/golden";

/// What the command of a file says now, in the form of the file.
std::string textNow(const std::string& firstLine) {
  const TemporaryFolder folder;
  const Outcome run = runShell(replaced(firstLine.substr(2), "DIR", folder.path()));
  const std::string text = firstLine + "\nexit code " + std::to_string(run.exitCode) +
                           "\n--- stdout\n" + run.out + "--- stderr\n" + run.err;
  return replaced(text, folder.path(), "DIR");
}

std::vector<std::string> names() {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(kFolder))
    found.push_back(entry.path().stem().string());
  std::ranges::sort(found);
  return found;
}

class Golden : public testing::TestWithParam<std::string> {};

TEST_P(Golden, CommandPrintsWhatItDid) {
  const fs::path file = kFolder / (GetParam() + ".txt");
  const std::string wanted = fileText(file);
  const std::string firstLine = wanted.substr(0, wanted.find('\n'));
  ASSERT_TRUE(firstLine.starts_with("$ swept ")) << file;
  if (GetParam().starts_with("help") && !programHasPages())
    GTEST_SKIP() << "swept was built without three.js";
  const std::string now = withoutTimes(textNow(firstLine));
  if (std::getenv("SWEPT_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(file) << now;
    return;
  }
  expectPrinted(now, wanted);
}

INSTANTIATE_TEST_SUITE_P(Commands, Golden, testing::ValuesIn(names()),
                         [](const auto& one) { return one.param; });

TEST(GoldenComparison, NoticesWhatMatters) {
  EXPECT_TRUE(agree("1.5", "1.5004"));
  EXPECT_FALSE(agree("1.5", "1.502"));
  EXPECT_TRUE(agree("#", "7"));
  EXPECT_FALSE(agree("7", "-7"));
  EXPECT_EQ(withoutTimes("took 1.5e-3 s, 20.0 ns; \"planning_time\": 0.2, 3 segments"),
            "took # s, # s; \"planning_time\": #, 3 segments");
  EXPECT_EQ(Pieces("a  1.5 b").between, Pieces("a 2 b").between);
  EXPECT_NE(Pieces("a 1.5 b").between, Pieces("a 2 c").between);
}

}  // namespace
}  // namespace swept::test
