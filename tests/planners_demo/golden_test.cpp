// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "models_dir.hpp"
#include "page_data.hpp"
#include "program.hpp"

/// What commands print is what the files in golden/ hold: the command in the first line, its exit
/// code, stdout and stderr. `DIR` stands for an empty folder and `#` for any number; other numbers
/// agree to a thousandth, since another instruction set may order sums in another way.
/// SWEPT_UPDATE_GOLDEN=1 writes the files anew from their first lines.
namespace swept::test {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(modelsDir()).parent_path() / "tests/planners_demo/golden";
constexpr double kTolerance = 1e-3;
constexpr double kAbsolute = 1e-9;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::string fileText(const fs::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// What the command of a file says now, in the form of the file.
std::string textNow(const std::string& firstLine) {
  const TemporaryFolder folder;
  const Outcome run = runShell(replaced(firstLine.substr(2), "DIR", folder.path()));
  const std::string text = firstLine + "\nexit code " + std::to_string(run.exitCode) +
                           "\n--- stdout\n" + run.out + "--- stderr\n" + run.err;
  return replaced(text, folder.path(), "DIR");
}

/// Times differ from run to run.
std::string withoutTimes(const std::string& text) {
  static const std::regex kSeconds("[0-9.]+(e-?[0-9]+)? (s|ms|us|ns)\\b");
  static const std::regex kFields("(\"(seconds|[a-z_]*time)\": )[0-9][-+.0-9e]*");
  return std::regex_replace(std::regex_replace(text, kSeconds, "# s"), kFields, "$1#");
}

/// Numbers and what is between them; runs of blanks, which align columns, are one.
struct Pieces {
  std::vector<std::string> between, numbers;

  explicit Pieces(const std::string& text) {
    static const std::regex kNumber("#|-?[0-9]+(\\.[0-9]+)?(e[-+]?[0-9]+)?");
    static const std::regex kBlanks(" +");
    const auto add = [&](const std::string& piece) {
      between.push_back(std::regex_replace(piece, kBlanks, " "));
    };
    std::size_t done = 0;
    for (std::sregex_iterator it(text.begin(), text.end(), kNumber), end; it != end; ++it) {
      const auto at = static_cast<std::size_t>(it->position());
      add(text.substr(done, at - done));
      numbers.push_back(it->str());
      done = at + static_cast<std::size_t>(it->length());
    }
    add(text.substr(done));
  }
};

bool agree(const std::string& wanted, const std::string& found) {
  if (wanted == "#" || wanted == found) return true;
  if (found == "#") return false;
  const double a = std::stod(wanted), b = std::stod(found);
  return std::abs(a - b) <= kAbsolute + kTolerance * std::max(std::abs(a), std::abs(b));
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
  const Pieces expected(wanted), found(now);
  EXPECT_EQ(expected.between, found.between) << now;
  ASSERT_EQ(expected.numbers.size(), found.numbers.size());
  for (std::size_t i = 0; i < found.numbers.size(); ++i)
    EXPECT_TRUE(agree(expected.numbers[i], found.numbers[i]))
        << expected.numbers[i] << " before, now " << found.numbers[i] << " in\n"
        << now;
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
