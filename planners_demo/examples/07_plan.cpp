// SPDX-License-Identifier: BSD-3-Clause
// Plans from one named state of a group to another, and proves every segment of the path:
//   example_07_plan ROBOT.urdf ROBOT.srdf SCENE GROUP START GOAL
// Exits 0 if all of them are proven free.
#include <cstdlib>
#include <exception>
#include <iostream>

#include "swept/ompl_bridge/ompl_bridge.hpp"

int plan(char** argv) {
  const auto robot = swept::Robot::load(argv[1], argv[2]);
  const auto world = std::make_shared<const swept::World>(swept::World::load(argv[3]));
  const auto checker = std::make_shared<const swept::Checker>(robot, argv[4], world);

  const auto setup = swept::makeSimpleSetup(checker);
  const auto state = [&](const char* name) {
    return swept::namedConfiguration(*robot, checker->group(), name);
  };
  swept::setStartAndGoal(*setup, *checker, state(argv[5]), state(argv[6]));
  setup->setPlanner(std::make_shared<swept::CertifiedConnect>(setup->getSpaceInformation()));
  if (setup->solve(10.0) != ompl::base::PlannerStatus::EXACT_SOLUTION) return 1;

  swept::shortenPath(setup->getSolutionPath());
  setup->getSolutionPath().printAsMatrix(std::cout);
  for (const auto& segment : swept::certifyPath(setup->getSolutionPath(), *checker)) {
    std::cout << "segment " << toString(segment.verdict) << '\n';
    if (segment.verdict != swept::Verdict::Free) return 2;
  }
  return 0;
}

int main(int argc, char** argv) try {
  if (argc == 7) return plan(argv);
  std::cerr << "usage: " << argv[0] << " ROBOT.urdf ROBOT.srdf SCENE GROUP START GOAL\n";
  return 3;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
