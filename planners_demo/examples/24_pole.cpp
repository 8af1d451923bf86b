// SPDX-License-Identifier: BSD-3-Clause
// An arm moves around a pole: planned, timed, proven as its controller executes it, and shown.
//   example_24_pole MODELS [FOLDER]
// Writes pole.json, which `swept verify` checks, and pole.html. Exits 0 if the way is proven, and
// the straight motion hits the pole.
#include <filesystem>
#include <iostream>

#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/pages/page.hpp"
#include "swept/proofs/path_proof.hpp"

int main(int argc, char** argv) try {
  const std::string arm = std::string(argc > 1 ? argv[1] : "models") + "/robots/rook7/rook7";
  const std::filesystem::path folder = argc > 2 ? argv[2] : std::filesystem::temp_directory_path();
  const auto robot = swept::Robot::load(arm + ".urdf", arm + ".srdf");
  swept::World world;
  const Eigen::Isometry3d middle(Eigen::Translation3d(0.4, 0, 1));
  world.add("pole", swept::makeCylinder(0.03, 2.0), middle);
  swept::CheckerOptions options;
  options.worldMargin = 0.02;  // m
  const auto checker = std::make_shared<const swept::Checker>(
      robot, "arm", std::make_shared<const swept::World>(world), options);

  // The arm reaches past the pole on either side: only the joint at the base differs.
  std::vector<double> start = swept::namedConfiguration(*robot, checker->group(), "ready");
  std::vector<double> goal = start;
  start[0] = -0.7;
  goal[0] = 0.7;
  swept::Workspace workspace(*checker);
  const auto straight = checker->certifyMotion(start, goal, workspace);
  std::cout << "straight: " << toString(straight.verdict) << " at t = " << straight.freeUntil
            << '\n';

  const auto setup = swept::makeSimpleSetup(checker);
  swept::setStartAndGoal(*setup, *checker, start, goal);
  setup->setPlanner(std::make_shared<swept::CertifiedConnect>(setup->getSpaceInformation()));
  swept::RateLimits limits = swept::RateLimits::of(*robot, checker->group());
  for (double& limit : limits.acceleration) limit = 3.0;  // rad/s^2
  const swept::PlannedTrajectory planned = swept::planTrajectory(*setup, limits);
  if (!planned.isProven()) return 1;

  const auto& [points, curve, corners] = planned.trajectory->timed;
  const swept::TrajectoryQuery query{.limits = limits, .clearances = true};
  const auto proof = checker->certifyTrajectory(curve, workspace, query);
  if (!swept::writeTrajectoryProof(folder / "pole.json", *checker, points, proof).isWritten())
    return 2;
  const swept::CheckedProof checked = swept::verifyProof(folder / "pole.json");
  std::cout << "around: " << curve.duration() << " s, never nearer than " << checked.clearanceWorld
            << " m to the pole\n";
  swept::Page page(checker);
  page.addTrajectory("around", curve, query);
  page.write(folder / "pole.html");
  return checked.holds() && straight.verdict == swept::Verdict::Collision ? 0 : 3;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 4;
}
