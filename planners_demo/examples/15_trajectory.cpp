// SPDX-License-Identifier: BSD-3-Clause
// The trajectory that a controller is given: is the curve that it makes of it free, and all that
// the robot may be off by? Needs no OMPL.
//   example_15_trajectory MODELS
// Exits 0 if the curve is free where the straight motions between its points are, and is not in a
// wide tube.
#include <iostream>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/joint_trajectory.hpp"

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const std::string arm = models + "/robots/rook7/rook7";
  const auto robot = swept::Robot::load(arm + ".urdf", arm + ".srdf");
  const auto world = std::make_shared<swept::World>();
  world->add("post", swept::makeCylinder(0.05, 1.0),
             Eigen::Isometry3d(Eigen::Translation3d(0.62, 0.35, 0.5)));
  const swept::Checker checker(robot, "arm", world);

  // Positions and velocities: a controller makes cubics of them. readTrajectories() reads the same
  // from the messages of ROS, CSV or JSON.
  swept::JointTrajectory trajectory;
  trajectory.variables = {"joint1", "joint2", "joint3", "joint4", "joint5", "joint6", "joint7"};
  trajectory.points = {{0.0, {-0.4, -0.5, 0.0, 1.5, 0.0, 0.8, 0.0}, {0, 0, 0, 0, 0, 0, 0}, {}},
                       {0.8, {0.0, -0.4, 0.0, 1.4, 0.0, 0.8, 0.2}, {0.3, 0.1, 0, 0, 0, 0, 0.4}, {}},
                       {1.6, {0.1, -0.2, 0.0, 1.2, 0.0, 0.8, 0.5}, {0, 0, 0, 0, 0, 0, 0}, {}}};
  const swept::PiecewisePolynomial curve = swept::controllerCurve(trajectory);

  swept::Workspace workspace(checker);
  swept::TrajectoryQuery query;
  query.limits = swept::RateLimits::of(*robot, checker.group());  // of the URDF
  query.clearances = true;
  const auto certificate = checker.certifyTrajectory(curve, workspace, query);
  std::cout << "curve: " << toString(certificate.verdict) << ", keeps " << certificate.world->lower
            << " m to the world, " << certificate.violations.size() << " limits left\n";

  // Each joint off by up to 0.01 rad, however it likes: and by 0.2.
  const swept::Checker tube = checker.withTracking({{.rotation = 0.01}, {}});
  const auto inTube = tube.certifyTrajectory(curve, workspace, query);
  const swept::Checker wide = checker.withTracking({{.rotation = 0.2}, {}});
  const auto inWide = wide.certifyTrajectory(curve, workspace, query);
  std::cout << "off by 0.01 rad: " << toString(inTube.verdict)
            << ", by 0.2 rad: " << toString(inWide.verdict) << '\n';
  if (inWide.contact)
    std::cout << "  at " << inWide.contact->time << " s, " << inWide.contact->witness.bodyA.str()
              << " - " << inWide.contact->witness.bodyB.str() << '\n';
  return certificate.verdict == swept::Verdict::Free && inTube.verdict == swept::Verdict::Free &&
                 inWide.verdict != swept::Verdict::Free
             ? 0
             : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
