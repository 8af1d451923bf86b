// SPDX-License-Identifier: BSD-3-Clause
//
// Names and values of a file may be as long as the file. Messages about them are for people.
#include "text/short_message.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/world.hpp"

namespace swept {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Le;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

constexpr std::size_t kLong = 1 << 20;

TEST(ShortMessage, WhatPeopleWriteStays) {
  for (const std::string& text :
       {std::string(), std::string("link 'a'  has 3 values; allowed are 4"), std::string(512, 'x')})
    EXPECT_EQ(detail::shortMessage(text), text);
}

TEST(ShortMessage, LongWordsKeepTheirEnds) {
  EXPECT_EQ(detail::shortMessage("link '" + std::string(600, 'x') + "end' is here"),
            "link '" + std::string(199, 'x') + "... (345 bytes) ..." + std::string(56, 'x') +
                "end' is here");
}

TEST(ShortMessage, ZerosAreShown) {
  using std::string_literals::operator""s;
  EXPECT_EQ(detail::shortMessage("no 'a\0\0b', but 'c'"s), "no 'a\\u0000\\u0000b', but 'c'");
}

TEST(ShortMessage, CharactersStayWhole) {
  std::string word = "a";
  for (int i = 0; i < 300; ++i) word += "\xc3\xa4";
  const std::string text = detail::shortMessage(word);
  EXPECT_LT(text.size(), 300U);
  EXPECT_THAT(text, StartsWith("a\xc3\xa4"));
  EXPECT_THAT(text, HasSubstr("\xc3\xa4... ("));
  EXPECT_THAT(text, HasSubstr(" bytes) ...\xc3\xa4"));
}

TEST(ShortMessage, LongTextKeepsItsEnds) {
  std::string text = "first";
  for (int i = 0; i < 10'000; ++i) text += " word";
  EXPECT_THAT(detail::shortMessage(text + " last"),
              AllOf(SizeIs(Le(4000U)), StartsWith("first word"), EndsWith("word last")));
}

std::string urdf(const std::string& base, const std::string& joint = "") {
  return "<robot name='r'><link name='a'>" + base +
         "</link><link name='b'/><joint name='j' type='revolute'><parent link='a'/>"
         "<child link='b'/><axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='1' "
         "velocity='1'/>" +
         joint + "</joint></robot>";
}

TEST(ShortMessage, IsWhatReadersSayOfLongNamesAndValues) {
  const std::string name(kLong, 'x');
  const test::TemporaryFolder folder;
  const auto robot = [](const std::string& text, const std::string& srdf = "") {
    return [=](const LoadOptions& options) {
      (void)Robot::parse(text, "r.urdf", srdf, "r.srdf", options);
    };
  };
  const auto scene = [&](const std::string& text) {
    return [&folder, text](const LoadOptions& options) {
      (void)World::load(folder.write("s.yaml", text), options);
    };
  };
  const std::vector<std::function<void(const LoadOptions&)>> readers{
      robot(urdf("<collision><geometry><sphere radius='" + name + "'/></geometry></collision>")),
      robot(
          urdf("<collision><geometry><mesh filename='" + name + ".stl'/></geometry></collision>")),
      robot(urdf("<collision><geometry><" + name + "/></geometry></collision>")),
      robot(urdf("<" + name + "/>")),
      robot(urdf("", "<mimic joint='" + name + "'/>")),
      robot(urdf(""), "<robot name='" + name + "'/>"),
      robot(urdf(""),
            "<robot name='r'><group name='" + name + "'><joint name='k'/></group></robot>"),
      robot(urdf(""),
            "<robot name='r'><disable_collisions link1='" + name + "' link2='b'/></robot>"),
      scene("collision_objects:\n- id: " + name + "\n  primitives: 3\n"),
      scene("collision_objects:\n- id: q\n  header: {frame_id: " + name +
            "}\n  primitives: [{type: 1, dimensions: [1, 1, 1]}]\n"
            "  primitive_poses: [{position: {x: 1, y: 0, z: 0}}]\n"),
  };
  for (std::size_t i = 0; i < readers.size(); ++i) {
    test::Warnings warnings;
    const std::string error = test::inputError([&] { readers[i](warnings.options()); });
    if (!error.empty()) warnings.lines.push_back(error);
    EXPECT_THAT(warnings.lines, Not(SizeIs(0))) << i;
    EXPECT_THAT(warnings.lines, Each(SizeIs(Le(4200U)))) << i;
    EXPECT_THAT(warnings.lines, Each(Not(HasSubstr(name.substr(0, 512))))) << i;
  }
}

}  // namespace
}  // namespace swept
