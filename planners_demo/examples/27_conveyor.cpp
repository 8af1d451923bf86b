// SPDX-License-Identifier: BSD-3-Clause
// A crate on a conveyor passes below an arm that reaches down: when may the arm start?
//   example_27_conveyor MODELS
// Exits 0 if some starts are proven, others collide with the crate, and it is free without one.
#include <iostream>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/named_states.hpp"

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const std::string arm = models + "/robots/rook7/rook7";
  const auto robot = swept::Robot::load(arm + ".urdf", arm + ".srdf");
  const swept::Checker empty(robot, "arm", std::make_shared<swept::World>());

  // 0.5 m/s along y, 0.6 m in front of the arm.
  const auto at = [](double y) { return Eigen::Isometry3d(Eigen::Translation3d(0.6, y, 0.25)); };
  const swept::Checker checker = empty.withObstacle(
      {.name = "crate",
       .parts = {{swept::makeBox({0.2, 0.3, 0.3}), Eigen::Isometry3d::Identity()}},
       .waypoints = {{0.0, at(-2.0)}, {8.0, at(2.0)}}});

  // From tucked over the conveyor and back, in 2 s: cubics, as a controller makes them.
  const auto tucked = swept::namedConfiguration(*robot, checker.group(), "tucked");
  const std::vector<double> reaching{0, 1.3, 0, 0.3, 0, 0, 0}, rest(7, 0.0);
  const swept::PiecewisePolynomial curve = swept::controllerCurve(
      {.variables = {"joint1", "joint2", "joint3", "joint4", "joint5", "joint6", "joint7"},
       .points = {{0.0, tucked, rest, {}}, {1.0, reaching, rest, {}}, {2.0, tucked, rest, {}}}});

  swept::Workspace workspace(checker);
  int free = 0, met = 0;
  for (double start = 0.0; start <= 6.0; start += 0.5) {
    // The clock shows `start` when the arm begins.
    const auto found = checker.certifyTrajectory(curve, workspace, {.clock = start});
    free += found.verdict == swept::Verdict::Free ? 1 : 0;
    met += found.verdict == swept::Verdict::Collision ? 1 : 0;
    std::cout << "start at " << start << " s: " << toString(found.verdict);
    if (found.contact)
      std::cout << ", " << found.contact->witness.bodyA << " meets " << found.contact->witness.bodyB
                << " at " << start + found.contact->time << " s";
    std::cout << '\n';
  }
  const auto alone = empty.certifyTrajectory(curve, workspace);
  return free > 0 && met > 0 && alone.verdict == swept::Verdict::Free ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
