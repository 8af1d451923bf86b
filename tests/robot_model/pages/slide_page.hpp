// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

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

/// One value: from 0 to 1 m at rest within 2 s, waits, and goes on to `end` at an even speed within
/// 1 s; from `begin` on.
inline PiecewisePolynomial rideTo(double end, double begin = 0.0) {
  std::vector<Eigen::MatrixXd> pieces;
  for (const std::vector<double>& row :
       {std::vector<double>{0, 0, 0, 1, 1, 1}, std::vector<double>{1, 1, 1}, {1, end}})
    pieces.push_back(Eigen::Map<const Eigen::RowVectorXd>(row.data(), std::ssize(row)));
  return {{begin, begin + 2.0, begin + 2.25, begin + 3.25}, pieces};
}

/// What an action is refused with.
inline std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace swept::test
