// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace swept::test {

/// m, between the two balls of slideUrdf() in every state: nearer than most of a world is.
inline constexpr double kSlideGap = 0.0136;
/// m, of each of its balls.
inline constexpr double kSlideRadius = 0.05;

/// A carriage on a slide along `axis` (such as `1 0 0`) and a hand that turns beside it: the two
/// are a constant distance apart, so that they hide the world from a clearance of all pairs.
inline std::string slideUrdf(const std::string& axis) {
  return R"(<robot name='slide'>
  <link name='base'/>
  <link name='carriage'><collision><geometry><sphere radius='0.05'/></geometry></collision></link>
  <link name='wrist'/>
  <link name='hand'><collision><geometry><sphere radius='0.05'/></geometry></collision></link>
  <joint name='slide' type='prismatic'><parent link='base'/><child link='carriage'/>
    <axis xyz=')" +
         axis + R"('/><limit lower='-2' upper='2' effort='1' velocity='1'/></joint>
  <joint name='turn' type='revolute'><parent link='carriage'/><child link='wrist'/>
    <origin xyz='0.1136 0 0'/><axis xyz='0 0 1'/>
    <limit lower='-3' upper='3' effort='1' velocity='1'/></joint>
  <joint name='grip' type='fixed'><parent link='wrist'/><child link='hand'/></joint>
</robot>)";
}

}  // namespace swept::test
