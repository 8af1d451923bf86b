// SPDX-License-Identifier: BSD-3-Clause
// A gripper picks up a can, carries it and releases it. Each step makes a new checker.
//   example_11_attach MODELS
// Exits 0 if the can meets a rail when its path says so, and is placed where the arm has turned it.
#include <cmath>
#include <iostream>
#include <numbers>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/link_motion.hpp"

using Eigen::Isometry3d, Eigen::Translation3d, Eigen::Vector3d;

int main(int argc, char** argv) try {
  const std::string arm = std::string(argc > 1 ? argv[1] : "models") + "/robots/rook7/rook7";
  const auto robot = swept::Robot::load(arm + ".urdf", arm + ".srdf");
  // The tool points straight down at a can, and the fingers (the last value) are closed.
  const std::vector<double> grasp{0, -0.3, 0, 1.9, 0, std::numbers::pi - 1.6, 0, 0.03};
  const swept::Shape can = swept::makeCylinder(0.035, 0.3);
  const Isometry3d hand_from_can(Translation3d(0, 0, 0.25));
  const Isometry3d world_from_can =
      swept::linkPose(*robot, "arm_with_gripper", "hand", grasp) * hand_from_can;
  swept::World world;
  world.add("can", can, world_from_can);
  world.add("rail", swept::makeBox({1.0, 0.02, 0.4}), Isometry3d(Translation3d(0.6, 0.2, 0.2)));
  const swept::Checker reach(robot, "arm_with_gripper", std::make_shared<swept::World>(world));
  swept::Workspace workspace(reach);
  bool right = reach.checkState(grasp, workspace) == swept::Verdict::Collision;
  // Fingers may touch what they hold.
  const swept::Checker carry = reach.withoutBody("can").withAttached(
      "can", "hand", can, hand_from_can, {"finger_left", "finger_right"});
  right &= carry.checkState(grasp, workspace) == swept::Verdict::Free;

  // The first joint turns. The can's middle moves on a circle; its side reaches y = 0.19 m.
  std::vector<double> turned = grasp;
  turned[0] = 1.2;  // rad
  const auto full = carry.certifyMotion(grasp, turned, workspace);
  const auto empty = carry.withoutAttached("can").certifyMotion(grasp, turned, workspace);
  const double touch = std::asin((0.19 - 0.035) / world_from_can.translation().x()) / 1.2;
  std::cout << "with the can " << toString(full.verdict) << ", free until " << full.freeUntil
            << ", by hand " << touch << "; without " << toString(empty.verdict) << '\n';
  right &= empty.verdict == swept::Verdict::Free && full.verdict == swept::Verdict::Collision;
  right &= full.freeUntil <= touch && touch < full.freeUntil + 0.01;

  // Released half-way, the can becomes a body of the world where it is. Then the fingers open.
  std::vector<double> there = grasp;
  there[0] = 0.3;
  const swept::WorldBody put = carry.detachedBody("can", there);
  const swept::Checker leave = carry.withoutAttached("can").withBody(put);
  right &= put.parts[0].world_from_shape.isApprox(
      Eigen::AngleAxisd(0.3, Vector3d::UnitZ()) * world_from_can, 1e-12);
  right &= leave.checkState(there, workspace) == swept::Verdict::Collision;
  there.back() = 0.04;
  return right && leave.checkState(there, workspace) == swept::Verdict::Free ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
