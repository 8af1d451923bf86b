// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "swept/pages/page.hpp"

namespace swept::test {

/// A ball of radius 0.1 m on a slide along x, from -3 to 3 m, with a wall of 0.1 m at 1.5 m.
inline std::shared_ptr<const Checker> slide(double wallAt = 1.5,
                                            const CheckerOptions& options = {}) {
  const auto robot = Robot::parse(
      "<robot name='slide'><link name='base'/><link name='ball'><visual><geometry><box size='0.1 "
      "0.2 0.3'/></geometry></visual><collision><geometry><sphere radius='0.1'/></geometry>"
      "</collision></link><joint name='x' type='prismatic'><parent link='base'/><child "
      "link='ball'/><axis xyz='1 0 0'/><limit lower='-3' upper='3' effort='1' velocity='1'/>"
      "</joint></robot>",
      "slide.urdf");
  const auto world = std::make_shared<World>();
  world->add(WorldBody{
      .name = "wall",
      .parts = {{makeBox({0.1, 1, 1}), Eigen::Isometry3d(Eigen::Translation3d(wallAt, 0, 0))}}});
  return std::make_shared<const Checker>(robot, "all", world, options);
}

inline nlohmann::json dataOf(const Page& page) {
  const std::string html = page.html(), begin = "<script id=\"data\" type=\"application/json\">";
  const std::size_t at = html.find(begin) + begin.size();
  return nlohmann::json::parse(html.substr(at, html.find("</script>", at) - at));
}

}  // namespace swept::test
