// SPDX-License-Identifier: BSD-3-Clause
// Plans with the hand kept within 30 degrees of how it stands at first, and looks at what the path
// does between its way points: example_18_keep_upright MODELS. Exits 0 if all of it is proven.
#include <algorithm>
#include <cmath>
#include <exception>
#include <iostream>
#include <numbers>
#include <vector>

#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/robot_model/link_motion.hpp"

int plan(const std::string& models) {
  const std::string rook = models + "/robots/rook7/rook7";
  const auto robot = swept::Robot::load(rook + ".urdf", rook + ".srdf");
  const auto world = std::make_shared<const swept::World>();
  const swept::Checker free(robot, "arm", world);
  const auto start = swept::namedConfiguration(*robot, free.group(), "ready");
  const std::string tip = robot->links()[free.group().tipLink].name;
  const auto poseAt = [&](const auto& q) { return swept::linkPose(*robot, "arm", tip, q); };
  const Eigen::Isometry3d level = poseAt(start);

  // The same posture, turned about the vertical by the joint at the base.
  std::vector<double> goal = start;
  goal[0] += 1.5;
  const double most = 30.0 * std::numbers::pi / 180.0;
  const auto checker = std::make_shared<const swept::Checker>(
      free.withConstraints(swept::TaskConstraint::level(tip, level, most)));

  const auto setup = swept::makeSimpleSetup(checker);
  swept::setStartAndGoal(*setup, *checker, start, goal);
  setup->setPlanner(std::make_shared<swept::CertifiedConnect>(setup->getSpaceInformation()));
  if (setup->solve(10.0) != ompl::base::PlannerStatus::EXACT_SOLUTION) return 1;
  for (const auto& segment : swept::certifyPath(setup->getSolutionPath(), *checker))
    if (segment.verdict != swept::Verdict::Free) return 2;

  // What is proven, sampled: how far what points up at the start tilts.
  const Eigen::Vector3d axis = level.linear().row(2);
  double largest = 0.0;
  auto& path = setup->getSolutionPath();
  path.interpolate(1000);
  for (const auto& q : swept::configurationsOf(path, *checker)) {
    const double cosine = (poseAt(q).linear() * axis).z();
    largest = std::max(largest, std::acos(std::min(1.0, cosine)));
  }
  std::cout << "the hand tilts by " << largest << " rad, allowed are " << most << '\n';
  return largest <= most ? 0 : 3;
}

int main(int argc, char** argv) try {
  return plan(argc > 1 ? argv[1] : "models");
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 4;
}
