// SPDX-License-Identifier: BSD-3-Clause
// Groups of an SRDF in each other. They are resolved one within the other, and 25,000 of them
// (1.3 MB) ended the process: its stack was full.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "input_files.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {
namespace {

using test::inputError;

constexpr const char* kUrdf = R"(<robot name="r"><link name="a"/><link name="b"/>
<joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint></robot>)";

std::string group(int i, int last) {
  const std::string inner =
      i == last ? "<joint name='j'/>" : "\n<group name='g" + std::to_string(i + 1) + "'/>";
  return "<group name='g" + std::to_string(i) + "'>" + inner + "</group>\n";
}

/// `g1` contains `g2` and so on; on two lines each, from line 2 on.
std::string outermostFirst(int count) {
  std::string text = "<robot name='r'>\n";
  for (int i = 1; i <= count; ++i) text += group(i, count);
  return text + "</robot>";
}

/// The last one stands on line 2.
std::string innermostFirst(int count) {
  std::string text = "<robot name='r'>\n";
  for (int i = count; i >= 1; --i) text += group(i, count);
  return text + "</robot>";
}

std::shared_ptr<const Robot> parse(const std::string& srdf) {
  return Robot::parse(kUrdf, "r.urdf", srdf, "r.srdf");
}

TEST(SrdfNesting, FiveHundredGroupsInEachOther) {
  for (const std::string& srdf : {outermostFirst(500), innermostFirst(500)}) {
    const auto robot = parse(srdf);
    ASSERT_EQ(robot->groups().size(), 500U);
    for (const Group& group : robot->groups()) EXPECT_EQ(group.joints.size(), 1U) << group.name;
  }
}

TEST(SrdfNesting, MoreAreRefused) {
  EXPECT_EQ(inputError([] { parse(outermostFirst(501)); }),
            "r.srdf:1001: error: group 'g501': groups are nested deeper than 500");
  EXPECT_EQ(inputError([] { parse(innermostFirst(501)); }),
            "r.srdf:1002: error: group 'g1': groups are nested deeper than 500");
  EXPECT_EQ(inputError([] { parse(outermostFirst(25'000)); }),
            "r.srdf:1001: error: group 'g501': groups are nested deeper than 500");
}

TEST(SrdfNesting, ManySideBySideAreFine) {
  std::string srdf = "<robot name='r'>\n<group name='all'>";
  for (int i = 0; i < 600; ++i) srdf += "<group name='s" + std::to_string(i) + "'/>";
  srdf += "</group>\n";
  for (int i = 0; i < 600; ++i)
    srdf += "<group name='s" + std::to_string(i) + "'><joint name='j'/></group>\n";
  EXPECT_EQ(parse(srdf + "</robot>")->groups().size(), 601U);
}

TEST(SrdfNesting, ALongLoopIsOne) {
  std::string srdf = "<robot name='r'>\n";
  for (int i = 1; i <= 400; ++i) srdf += group(i, 0);
  srdf += "<group name='g401'>\n<group name='g1'/></group>\n</robot>";
  EXPECT_EQ(inputError([&] { parse(srdf); }), "r.srdf:803: error: group 'g1' contains itself");
}

}  // namespace
}  // namespace swept
