// SPDX-License-Identifier: BSD-3-Clause
#include "output/text_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "output/line_breaks.hpp"
#include "output/terminal_text.hpp"

namespace swept {
namespace {

using testing::ElementsAre;

TextTable cities() {
  TextTable table({{"name"}, {"number of people", true}, {"what is said of it"}});
  table.add({"Here", "1200000", "the trams, the hills, the rain"});
  table.add({"There", "7", ""});
  return table;
}

TEST(TextTable, IsARowPerLineWhereLinesMayBeLong) {
  EXPECT_EQ(cities().text({}),
            "name   number of people  what is said of it\n"
            "Here            1200000  the trams, the hills, the rain\n"
            "There                 7\n");
  EXPECT_EQ(cities().text(55), cities().text({})) << "it fits to the column";
}

TEST(TextTable, BreaksTitlesAndTextsToFit) {
  EXPECT_EQ(cities().text(36),
            "name    number  what is said of it\n"
            "            of\n"
            "        people\n"
            "Here   1200000  the trams, the\n"
            "                hills, the rain\n"
            "There        7\n");
}

TEST(TextTable, StacksRowsThatDoNotFitSideBySide) {
  EXPECT_EQ(cities().text(24),
            "name Here\n"
            "  number of\n"
            "  people: 1200000; what\n"
            "  is said of it: the\n"
            "  trams, the hills, the\n"
            "  rain\n"
            "name There\n"
            "  number of people: 7\n");
}

/// Numbers are to be compared with those above and below.
TEST(TextTable, PartsManyNumbersAmongSeveralTables) {
  TextTable table({{"set"}, {"solved", true}, {"median", true}, {"mean", true}, {"worst", true}});
  table.add({"shelf", "10/10", "0.001 s", "0.002 s", "0.01 s"});
  table.add({"bin", "9/10", "0.1 s", "0.2 s", "-"});
  table.add({"cage", "8/10", "0.1 s", "0.2 s", "-"});
  EXPECT_EQ(table.text(26),
            "set    solved   median\n"
            "shelf   10/10  0.001 s\n"
            "bin      9/10    0.1 s\n"
            "cage     8/10    0.1 s\n"
            "\n"
            "set       mean   worst\n"
            "shelf  0.002 s  0.01 s\n"
            "bin      0.2 s       -\n"
            "cage     0.2 s       -\n");
}

TEST(TextTable, CutsNoWordAndNoNumber) {
  TextTable table({{"link"}, {"value", true}});
  table.add({"a_name_of_more_letters_than_the_line", "0.123456789012345678"});
  const std::string text = table.text(20);
  EXPECT_THAT(text, testing::HasSubstr("a_name_of_more_letters_than_the_line\n"));
  EXPECT_THAT(text, testing::HasSubstr("  value: 0.123456789012345678\n"));
}

TEST(TextTable, CountsCharactersAndNotBytes) {
  TextTable table({{"wo"}, {"x", true}});
  table.add({"Tür", "1"});
  table.add({"Uhr", "2"});
  EXPECT_EQ(table.text({}), "wo   x\nTür  1\nUhr  2\n");
}

TEST(LineBreaks, FollowTheLastPart) {
  EXPECT_EQ(brokenLines("  clearance   0.1 m or more, and no more than 0.2 m\nnext\n", 32),
            "  clearance   0.1 m or more, and\n"
            "              no more than 0.2 m\n"
            "next\n");
  EXPECT_EQ(brokenLines("state 1: free, clearance 0.1 m", 16),
            "state 1: free,\n"
            "  clearance\n"
            "  0.1 m");
}

TEST(LineBreaks, LeaveWhatFitsAndWhatHasNoBlank) {
  EXPECT_EQ(brokenLines("12345678\n", 8), "12345678\n");
  EXPECT_EQ(brokenLines("123456789\n\n", 8), "123456789\n\n");
  EXPECT_EQ(brokenLines("", 8), "");
}

/// A shell has to read the command that was broken as the one that was not.
TEST(LineBreaks, OfACommandCanBePasted) {
  EXPECT_EQ(brokenLines("    swept check 'my robot.urdf' 0,1,2 --margin 0.1", 34),
            "    swept check 'my robot.urdf' \\\n"
            "        0,1,2 --margin 0.1");
}

TEST(LineBreaks, MarksOfColoursTakeNoColumns) {
  const std::string word = painted(Hue::Good, "free");
  EXPECT_EQ(widthOf(word), 4u);
  EXPECT_NE(painted(Verdict::Undecided), painted(Hue::Bad, "undecided"));
  EXPECT_NE(painted(Verdict::Undecided), painted(Hue::Good, "undecided"));
  EXPECT_THAT(brokenCell(word + " is it", 7, false), ElementsAre(word + " is", "it"));
}

}  // namespace
}  // namespace swept
