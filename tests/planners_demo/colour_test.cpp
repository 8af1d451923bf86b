// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gantry.hpp"

namespace swept::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr int kWide = 200;

std::string good(const std::string& word) {
  return "\033[32m" + word + "\033[0m";
}

std::string bad(const std::string& word) {
  return "\033[31m" + word + "\033[0m";
}

Outcome shown(const Gantry& gantry, const std::string& command, std::vector<std::string> more,
              const std::vector<std::string>& environment = {}) {
  return runOnTerminal(gantry.arguments(command, more), kWide, environment);
}

TEST(Colour, VerdictsHaveTheirOwnOnATerminal) {
  const Gantry gantry;
  EXPECT_THAT(shown(gantry, "check", {"left", "1,0"}).out,
              testing::AllOf(StartsWith("state 1 (left): " + good("free") + ", clearance "),
                             HasSubstr("\nstate 2: " + bad("collision") + "\n")));
  EXPECT_THAT(shown(gantry, "motion", {"left", "right"}).out,
              StartsWith("state 1 (left) to state 2 (right): " + bad("collision") + "\n"));
  EXPECT_THAT(shown(gantry, "plan", {"left", "right"}).out,
              HasSubstr("\n" + good("solved") + ": "));
  EXPECT_THAT(shown(gantry, "plan", {"left", "1,0"}).out, HasSubstr(bad("not solved") + ": "));
}

TEST(Colour, IsNothingButColour) {
  const Gantry gantry;
  for (const std::string command : {"check", "motion"}) {
    std::string text = shown(gantry, command, {"left", "right"}).out;
    for (const std::string code : {"\033[32m", "\033[31m", "\033[33m", "\033[0m"})
      for (std::size_t at = 0; (at = text.find(code)) != std::string::npos;)
        text.erase(at, code.size());
    EXPECT_EQ(text, gantry.run(command, {"left", "right"}).out);
  }
}

TEST(Colour, IsNotThereWhereItIsNotWanted) {
  const Gantry gantry;
  const std::string plain = gantry.run("check", {"left"}).out;
  EXPECT_THAT(plain, Not(HasSubstr("\033")));
  for (const std::string variable : {"NO_COLOR=1", "TERM=dumb", "TERM="})
    EXPECT_EQ(shown(gantry, "check", {"left"}, {variable}).out, plain) << variable;
  EXPECT_NE(shown(gantry, "check", {"left"}, {"NO_COLOR="}).out, plain) << "empty counts as unset";
}

TEST(Colour, JsonHasNone) {
  const Gantry gantry;
  for (const std::string command : {"check", "motion"})
    EXPECT_EQ(shown(gantry, command, {"left", "right", "--json"}).out,
              gantry.run(command, {"left", "right", "--json"}).out);
}

/// One may be piped while the other is not.
TEST(Colour, EachStreamIsJudgedByItself) {
  const Gantry gantry;
  const std::vector<std::string> words = gantry.arguments("check", {"nowhere"});
  EXPECT_THAT(runOnTerminal(words, kWide).err, StartsWith("swept: error: "));
  EXPECT_EQ(runSwept(gantry.arguments("check", {"left"}), Stderr::Terminal).out,
            gantry.run("check", {"left"}).out);
  EXPECT_THAT(runSwept(words, Stderr::Terminal).err, StartsWith("swept: " + bad("error:") + " "));
}

/// Of a name a terminal gets no colour, and nothing else.
TEST(Colour, NamesHaveNone) {
  const TemporaryFolder folder;
  folder.write("\x01r\x04.urdf", "<robot name='r'><link name='a'/></robot>");
  const Outcome run = runOnTerminal({"info", folder.path("\x01r\x04.urdf")}, kWide);
  EXPECT_THAT(run.out, HasSubstr("\\u0001r\\u0004.urdf\n"));
  EXPECT_THAT(run.out, Not(HasSubstr("\033")));
}

}  // namespace
}  // namespace swept::test
