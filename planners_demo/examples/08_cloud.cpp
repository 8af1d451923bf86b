// SPDX-License-Identifier: BSD-3-Clause
// The points of a depth camera as a body of the world, and the next cloud in its place, while
// others may go on with the checker of the earlier cloud.
//   example_08_cloud MODELS
// Exits 0 if the motion runs into a new point in its way.
#include <iostream>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/cloud_file.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/named_states.hpp"

using Eigen::Isometry3d;

constexpr double kRadius =
    0.015;  // m, radius of the ball that each point stands for: gaps between points, noise

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const std::string arm = models + "/robots/rook7/rook7";
  const auto robot = swept::Robot::load(arm + ".urdf", arm + ".srdf");
  std::vector<Eigen::Vector3d> points = swept::loadPoints(models + "/clouds/shelf.pcd");
  swept::World world;  // Points of the robot itself: see withoutRobot in self_filter.hpp.
  world.add("seen", swept::PointCloud::build(points, kRadius), Isometry3d::Identity());
  const swept::Checker checker(robot, "arm", std::make_shared<swept::World>(world));
  swept::Workspace workspace(checker);

  const auto home = swept::namedConfiguration(*robot, checker.group(), "home");
  const auto ready = swept::namedConfiguration(*robot, checker.group(), "ready");
  const auto before = checker.certifyMotion(home, ready, workspace);
  std::cout << points.size() << " points: " << toString(before.verdict) << '\n';

  // The next cloud has one more point, where the tool will be half-way.
  const auto half = checker.interpolate(home, ready, 0.5);
  const auto tool = swept::linkPose(*robot, "arm", "tool", half);
  points.push_back(tool.translation());
  const swept::Checker next = checker.withReplaced(
      "seen", swept::PointCloud::build(points, kRadius), Isometry3d::Identity());
  const auto after = next.certifyMotion(home, ready, workspace);
  std::cout << points.size() << " points: " << toString(after.verdict) << '\n';
  if (!after.witness) return 1;
  const swept::Witness& touch = *after.witness;
  const double off = (touch.pointB - points.back()).norm();
  std::cout << touch.bodyA << " touches " << touch.bodyB << " at t = " << touch.t << ", " << off
            << " m from the new point\n";

  const auto still = checker.certifyMotion(home, ready, workspace);
  return before.verdict == swept::Verdict::Free && still.verdict == swept::Verdict::Free &&
                 off <= kRadius + 1e-9
             ? 0
             : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
