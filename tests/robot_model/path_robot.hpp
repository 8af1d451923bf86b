// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "swept/robot_model/robot.hpp"

namespace swept::test {

/// A planar base that carries an arm of each kind of joint: `turn` from -2 to 2 rad, `wheel`
/// without limits, `slide` from 0 to 1 m, and `finger`, which follows `turn` by half. `head` is in
/// none of the groups `arm` (turn, wheel, slide) and `whole` (vj, turn, wheel, slide); `bolt` is
/// fixed.
inline std::shared_ptr<const Robot> pathRobot() {
  const auto joint = [](const std::string& name, const std::string& type, const std::string& child,
                        const std::string& more) {
    return "<link name='" + child + "'/><joint name='" + name + "' type='" + type +
           "'><parent link='base'/><child link='" + child + "'/>" + more + "</joint>";
  };
  const auto limit = [](const std::string& lower, const std::string& upper) {
    return "<limit lower='" + lower + "' upper='" + upper + "' effort='1' velocity='1'/>";
  };
  const std::string axis = "<axis xyz='0 0 1'/>";
  return Robot::parse(
      "<robot name='kinds'><link name='base'/>" +
          joint("turn", "revolute", "t", axis + limit("-2", "2")) +
          joint("wheel", "continuous", "w", axis) +
          joint("slide", "prismatic", "s", axis + limit("0", "1")) +
          joint("finger", "revolute", "f",
                axis + limit("-2", "2") + "<mimic joint='turn' multiplier='0.5'/>") +
          joint("head", "revolute", "h", axis + limit("-1", "1")) +
          joint("bolt", "fixed", "b", "") + "</robot>",
      "kinds.urdf",
      "<robot name='kinds'>"
      "<virtual_joint name='vj' type='planar' parent_frame='odom' child_link='base'/>"
      "<group name='arm'><joint name='turn'/><joint name='wheel'/><joint name='slide'/></group>"
      "<group name='whole'><joint name='vj'/><joint name='turn'/><joint name='wheel'/>"
      "<joint name='slide'/></group></robot>",
      "kinds.srdf");
}

}  // namespace swept::test
