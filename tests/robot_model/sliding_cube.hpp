// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::test {

/// A cube of 0.2 m that slides along x (-3 to 3 m) and along z (likewise).
inline std::shared_ptr<const Robot> slidingCube() {
  const auto slide = [](const std::string& name, const std::string& parent,
                        const std::string& child, const std::string& axis) {
    return "<joint name='" + name + "' type='prismatic'><parent link='" + parent +
           "'/><child link='" + child + "'/><axis xyz='" + axis +
           "'/><limit lower='-3' upper='3' effort='1' velocity='1'/></joint>";
  };
  return Robot::parse(
      "<robot name='slider'><link name='base'/><link name='carriage'/><link name='cube'><collision>"
      "<geometry><box size='0.2 0.2 0.2'/></geometry></collision></link>" +
          slide("x", "base", "carriage", "1 0 0") + slide("z", "carriage", "cube", "0 0 1") +
          "</robot>",
      "slider.urdf");
}

/// A cube of 0.2 m at the origin.
inline std::shared_ptr<const World> worldWithCube() {
  auto world = std::make_shared<World>();
  world->add(WorldBody{.name = "block",
                       .parts = {{makeBox({0.2, 0.2, 0.2}), Eigen::Isometry3d::Identity()}}});
  return world;
}

/// m, between the two cubes; 0 where they touch.
inline double cubeDistance(double x, double z) {
  return std::hypot(std::max(std::abs(x) - 0.2, 0.0), std::max(std::abs(z) - 0.2, 0.0));
}

}  // namespace swept::test
