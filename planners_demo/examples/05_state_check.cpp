// SPDX-License-Identifier: BSD-3-Clause
// Is a state of a robot free in a scene? What touches what, where, and how far is the nearest body?
//   example_05_state_check MODELS
// Exits 0 if the distance and place of the named bodies agree with clearance and contact.
#include <cmath>
#include <iostream>

#include "swept/core/distance.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/named_states.hpp"

using Eigen::Vector3d;

double distanceOf(const swept::Link& link, const Eigen::Isometry3d& pose,
                  const swept::WorldBody& body) {
  double least = INFINITY;
  for (const auto& piece : link.collision)
    for (const auto& [shape, world_from_shape] : body.parts) {
      const Eigen::Isometry3d a_from_b =
          (pose * piece.link_from_shape).inverse() * world_from_shape;
      least = std::min(least, swept::distance(piece.shape, shape, a_from_b).lower);
    }
  return least;
}

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const std::string arm = models + "/robots/rook7/rook7";
  const auto robot = swept::Robot::load(arm + ".urdf", arm + ".srdf");
  const swept::World world = swept::World::load(models + "/scenes/narrow_slot.yaml");
  const swept::Checker checker(robot, "arm", std::make_shared<swept::World>(world));
  swept::Workspace workspace(checker);  // one for each thread that uses the checker

  const auto ready = swept::namedConfiguration(*robot, checker.group(), "ready");
  const swept::StateReport free = checker.reportState(ready, workspace);
  std::cout << toString(free.verdict) << ", clearance " << free.clearance << " m, nearest "
            << free.nearestA << " - " << free.nearestB << '\n';
  const swept::Link& link = robot->links()[robot->findLink(free.nearestA).value()];
  const Eigen::Isometry3d pose = swept::linkPose(*robot, "arm", link.name, ready);
  const double gap = distanceOf(link, pose, *world.find(free.nearestB));
  bool right = free.verdict == swept::Verdict::Free && std::abs(free.clearance - gap) < 1e-6;

  const std::vector<double> reaching{0.2, 0.4, 0, 1.2, 0, 0.8, 0};  // rad
  const swept::StateReport blocked = checker.reportState(reaching, workspace);
  std::cout << toString(blocked.verdict) << '\n';
  for (const swept::Witness& touch : blocked.contacts) {
    std::cout << "  " << touch.bodyA << " touches " << touch.bodyB << " at "
              << touch.pointA.transpose() << '\n';
    // A plate is a box of 0.02 x 0.5 x 0.86 m around its middle.
    const Vector3d middle = world.find(touch.bodyB)->parts[0].world_from_shape.translation();
    const Vector3d beyond = (touch.pointB - middle).cwiseAbs() - Vector3d(0.01, 0.25, 0.43);
    right &= beyond.maxCoeff() < 1e-9;
  }
  return right && blocked.verdict == swept::Verdict::Collision ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
