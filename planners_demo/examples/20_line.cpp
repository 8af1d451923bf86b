// SPDX-License-Identifier: BSD-3-Clause
// A tool that goes along a straight line: way points, the proof that it never leaves the line by
// more than 1 mm, and why a longer line ends early.
#include <algorithm>
#include <iostream>
#include <memory>
#include <string>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/named_states.hpp"
#include "swept/robot_model/tool_line.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: 20_line MODELS\n";
    return 3;
  }
  const std::string folder = std::string(argv[1]) + "/robots/rook7/";
  const auto robot = swept::Robot::load(folder + "rook7.urdf", folder + "rook7.srdf");
  const auto checker =
      std::make_shared<const swept::Checker>(robot, "arm", std::make_shared<const swept::World>());
  swept::Workspace workspace(*checker);
  const auto start = swept::namedConfiguration(*robot, checker->group(), "ready");

  // The origin of the group's last link, 0.1 m down and 2 m down: that is out of reach.
  const std::string tip = robot->links()[checker->group().tipLink].name;
  const swept::ToolLinePlanner planner(checker, {.body = tip});
  const auto down = [&](double length) {
    Eigen::Isometry3d goal = planner.pose(start);
    goal.translation().z() -= length;
    return planner.plan(start, goal, workspace);
  };
  const swept::ToolLine line = down(0.1);
  std::cout << "0.1 m with " << line.wayPoints.size() << " way points, never more than "
            << 1e3 * line.position << " mm off\n";
  const swept::ToolLine beyond = down(2.0);
  if (beyond.stop) std::cout << "2 m: " << swept::describe(*beyond.stop, {}) << "\n";

  // Sampled, the tool is no farther off than was proven.
  double farthest = 0.0;
  for (std::size_t i = 1; i < line.wayPoints.size(); ++i)
    for (int k = 0; k <= 100; ++k) {
      const Eigen::VectorXd q =
          checker->interpolate(line.wayPoints[i - 1], line.wayPoints[i], k / 100.0);
      const Eigen::Vector3d off = planner.pose(q).translation() - planner.pose(start).translation();
      farthest = std::max(farthest, off.head<2>().norm());
    }
  return line.complete() && !beyond.complete() && farthest <= line.position ? 0 : 1;
}
