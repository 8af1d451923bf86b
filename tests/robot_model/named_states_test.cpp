// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/named_states.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace swept {
namespace {

std::shared_ptr<const Robot> twoSlides() {
  return Robot::parse(
      "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>"
      "<joint name='x' type='prismatic'><parent link='a'/><child link='b'/>"
      "<limit lower='0' upper='1' effort='1' velocity='1'/></joint>"
      "<joint name='y' type='prismatic'><parent link='b'/><child link='c'/>"
      "<limit lower='0' upper='1' effort='1' velocity='1'/></joint></robot>",
      "r.urdf",
      "<robot name='r'><group name='both'><joint name='x'/><joint name='y'/></group>"
      "<group name='one'><joint name='x'/></group>"
      "<group_state name='half' group='both'><joint name='x' value='0.5'/></group_state>"
      "<group_state name='full' group='both'><joint name='y' value='1'/><joint name='x' "
      "value='0.25'/>"
      "</group_state></robot>",
      "r.srdf");
}

/// The values come in the group's order, not in the order of the SRDF's elements.
TEST(NamedStates, HaveTheGroupsOrder) {
  const auto robot = twoSlides();
  const Group& both = *robot->findGroup("both");
  const std::vector<double> q = namedConfiguration(*robot, both, "full");
  EXPECT_EQ(q, (std::vector<double>{0.25, 1.0}));
  const NamedState again = makeNamedState(both, "again", q);
  EXPECT_EQ(again.name, "again");
  EXPECT_EQ(again.group, "both");
  EXPECT_EQ(again.values, (std::vector<std::pair<int, double>>{{0, 0.25}, {1, 1.0}}));
}

TEST(NamedStates, ThatAreMissingAreNamed) {
  const auto robot = twoSlides();
  const auto message = [&](const char* group, const char* name) -> std::string {
    try {
      namedConfiguration(*robot, *robot->findGroup(group), name);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message("both", "full"), "");
  EXPECT_EQ(message("both", "half"), "named state `half` of group `both` has no value for `y`");
  EXPECT_EQ(message("both", "home"),
            "group `both` has no named state `home`; it has half, full, default");
  EXPECT_EQ(message("one", "full"), "group `one` has no named state `full`; it has default");
  EXPECT_THROW(makeNamedState(*robot->findGroup("both"), "s", std::vector<double>{1.0}),
               std::invalid_argument);
}

}  // namespace
}  // namespace swept
