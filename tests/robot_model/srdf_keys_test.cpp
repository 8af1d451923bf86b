// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iterator>

#include "format_table.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::test {
namespace {

const char* const kUrdf = R"(<robot name="r">
  <link name="a"/><link name="b"/><link name="c"/>
  <joint name="j" type="revolute"><parent link="a"/><child link="b"/><limit lower="-1" upper="1"/></joint>
  <joint name="k" type="revolute"><parent link="b"/><child link="c"/><limit lower="-1" upper="1"/></joint>
</robot>)";

/// All that an SRDF can say of links, joints, groups, states and pairs.
std::string answerTo(const std::string& srdf) {
  const auto robot = Robot::parse(kUrdf, "r.urdf", srdf, "r.srdf");
  std::string text;
  for (const Joint& joint : robot->joints())
    text += joint.name + " " + std::to_string(static_cast<int>(joint.type)) +
            (joint.passive ? " passive\n" : "\n");
  for (const Group& group : robot->groups()) {
    text += "group " + group.name + ", " + std::to_string(group.tipLink) + ":";
    for (const int v : group.variables) text += " " + robot->variables()[v].name;
    text += "\n";
  }
  for (const NamedState& state : robot->namedStates()) {
    text += "state " + state.name + " of " + state.group + ":";
    for (const auto& [variable, value] : state.values)
      text += " " + std::to_string(variable) + "=" + std::to_string(value);
    text += "\n";
  }
  for (const DisabledPair& pair : robot->disabledPairs())
    text += "off " + std::to_string(pair.linkA) + " " + std::to_string(pair.linkB) + "\n";
  for (const EnabledPair& pair : robot->enabledPairs())
    text += "on " + std::to_string(pair.linkA) + " " + std::to_string(pair.linkB) + "\n";
  return text;
}

std::string robot(const std::string& inside, const std::string& attributes = "name='r'") {
  return "<robot " + attributes + ">" + inside + "</robot>";
}

KeyCase inside(const std::string& key, const std::string& without, const std::string& with) {
  return {key, robot(without), robot(with)};
}

std::vector<KeyCase> attributesOfJointsAndGroups() {
  const auto base = [](const std::string& name, const std::string& type, const std::string& more) {
    return "<virtual_joint name='" + name + "' type='" + type + "' child_link='a' " + more + "/>";
  };
  const auto group = [](const std::string& members) {
    return "<group name='g'>" + members + "</group>";
  };
  const std::string two = group("<joint name='j'/><joint name='k'/>");
  const std::string other = "<group name='h'><joint name='k'/></group>";
  return {
      {"robot name", robot(""), robot("", "name='other'")},
      {"robot version", robot(""), robot("", "name='r' version='1.0'")},
      {"robot xmlns", robot(""), robot("", "name='r' xmlns:xacro='http://ros.org/wiki/xacro'")},
      inside("virtual_joint name", base("v", "planar", ""), base("w", "planar", "")),
      inside("virtual_joint type", base("v", "planar", ""), base("v", "floating", "")),
      inside("virtual_joint child_link", "", base("v", "planar", "")),
      inside("virtual_joint parent_frame", base("v", "planar", ""),
             base("v", "planar", "parent_frame='odom'")),
      inside("group name", two, "<group name='other'><joint name='j'/><joint name='k'/></group>"),
      inside("group/chain base_link", group("<chain base_link='a' tip_link='c'/>"),
             group("<chain base_link='b' tip_link='c'/>")),
      inside("group/chain tip_link", group("<chain base_link='a' tip_link='c'/>"),
             group("<chain base_link='a' tip_link='b'/>")),
      inside("group/joint name", group("<joint name='j'/>"), group("<joint name='k'/>")),
      inside("group/link name", group("<link name='b'/>"), group("<link name='c'/>")),
      inside("group/group name", other + group(""), other + group("<group name='h'/>")),
      inside("group/passive_joint name", two,
             group("<joint name='j'/><joint name='k'/><passive_joint name='k'/>")),
      inside("passive_joint name", two, two + "<passive_joint name='k'/>"),
      inside("joint_property joint_name",
             two + "<joint_property joint_name='x' "
                   "property_name='motion_model' value='diff_drive'/>",
             two + "<joint_property joint_name='j' property_name='motion_model' "
                   "value='diff_drive'/>"),
      inside("joint_property property_name",
             two + "<joint_property joint_name='j' property_name='colour' value='blue'/>",
             two + "<joint_property joint_name='j' property_name='motion_model' value='blue'/>"),
      inside("joint_property value",
             two + "<joint_property joint_name='j' property_name='motion_model' "
                   "value='holonomic'/>",
             two + "<joint_property joint_name='j' property_name='motion_model' "
                   "value='diff_drive'/>"),
  };
}

std::vector<KeyCase> statesAndPairs() {
  const std::string groups =
      "<group name='g'><joint name='j'/><joint name='k'/></group>"
      "<group name='h'><joint name='j'/><joint name='k'/></group>";
  const auto state = [&](const std::string& name, const std::string& group,
                         const std::string& joint, const std::string& value) {
    return groups + "<group_state name='" + name + "' group='" + group + "'><joint name='" + joint +
           "' value='" + value + "'/></group_state>";
  };
  const auto pair = [](const std::string& word, const std::string& a, const std::string& b,
                       const std::string& more = {}) {
    return "<" + word + "_collisions link1='" + a + "' link2='" + b + "' " + more + "/>";
  };
  std::vector<KeyCase> cases{
      inside("group_state name", state("s", "g", "j", "0"), state("t", "g", "j", "0")),
      inside("group_state group", state("s", "g", "j", "0"), state("s", "h", "j", "0")),
      inside("group_state/joint name", state("s", "g", "j", "0"), state("s", "g", "k", "0")),
      inside("group_state/joint value", state("s", "g", "j", "0"), state("s", "g", "j", "1")),
      inside("disable_default_collisions link", "", "<disable_default_collisions link='c'/>"),
      inside("end_effector", groups, groups + "<end_effector name='e' parent_link='c' group='h'/>"),
      inside("link_sphere_approximation", "",
             "<link_sphere_approximation link='a'><sphere center='0 0 0' radius='0'/>"
             "</link_sphere_approximation>"),
      inside("gripper", "",
             "<gripper name='h' clearance='0.02'><position>0 0 0 0 0 0 1</position></gripper>"),
      inside("handle", "", "<handle name='h'><link name='a'/></handle>"),
      inside("contact", "", "<contact name='floor'><link name='a'/></contact>"),
      inside("rotor_params", "", "<rotor_params><joint name='j' mass='1'/></rotor_params>"),
      inside("specificities", "", "<specificities><feet/></specificities>"),
      inside("loop_constraint", "", "<loop_constraint frame1='a' frame2='c'/>"),
      inside("collision_margins", "", "<collision_margins default_margin='0.1'/>"),
  };
  for (const std::string word : {"disable", "enable"}) {
    cases.push_back(inside(word + "_collisions link1", pair(word, "a", "c"), pair(word, "b", "c")));
    cases.push_back(inside(word + "_collisions link2", pair(word, "a", "c"), pair(word, "a", "b")));
    cases.push_back(inside(word + "_collisions reason", pair(word, "a", "c"),
                           pair(word, "a", "c", "reason='Never'")));
  }
  return cases;
}

TEST(SrdfKeys, HaveTheFateThatTheTableSays) {
  std::vector<KeyCase> cases = attributesOfJointsAndGroups();
  std::ranges::copy(statesAndPairs(), std::back_inserter(cases));
  walkFormat("SRDF (.srdf)", cases, answerTo);
}

/// Of each element with attributes that are known, one more is refused; so is an element inside.
TEST(SrdfKeys, WhatIsNotInTheTableIsRefused) {
  const auto message = [](const std::string& srdf) -> std::string {
    try {
      answerTo(srdf);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  int checked = 0;
  for (const KeyCase& key : statesAndPairs())
    for (std::size_t end = key.with.find("/>"); end != std::string::npos;
         end = key.with.find("/>", end + 2)) {
      const bool known = key.key.find(' ') != std::string::npos;
      if (!known) continue;
      std::string more = key.with;
      more.insert(end, " frobnicate='1'");
      EXPECT_THAT(message(more), testing::HasSubstr("frobnicate")) << more;
      ++checked;
    }
  EXPECT_GT(checked, 10);
  EXPECT_THAT(message(robot("<frobnicate/>")), testing::HasSubstr("<frobnicate>"));
  EXPECT_THAT(message(robot("", "name='r' frobnicate='1'")), testing::HasSubstr("frobnicate"));
}

}  // namespace
}  // namespace swept::test
