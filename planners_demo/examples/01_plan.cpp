// SPDX-License-Identifier: BSD-3-Clause
// Plans from one state of a group to another, and proves every segment of the path:
//   example_01_plan ROBOT.urdf ROBOT.srdf SCENE GROUP START GOAL
// START and GOAL are named states of the SRDF, or comma-separated values in the order of the
// group's variables.
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <sstream>

#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace {

std::vector<double> configuration(const swept::Checker& checker, const std::string& text) {
  if (checker.robot().findNamedState(text, checker.group().name) != nullptr)
    return swept::namedConfiguration(checker.robot(), checker.group(), text);
  std::vector<double> q;
  std::istringstream values(text);
  for (std::string value; std::getline(values, value, ',');) q.push_back(std::stod(value));
  return q;
}

int plan(char** argv) {
  const auto robot = swept::Robot::load(argv[1], argv[2]);
  const auto world = std::make_shared<const swept::World>(swept::World::load(argv[3]));
  const auto checker = std::make_shared<const swept::Checker>(robot, argv[4], world);

  const auto setup = swept::makeSimpleSetup(checker);
  const swept::StateConversion conversion(*robot, checker->group());
  ompl::base::ScopedState<> start(setup->getStateSpace()), goal(setup->getStateSpace());
  conversion.toState(configuration(*checker, argv[5]), start.get());
  conversion.toState(configuration(*checker, argv[6]), goal.get());
  setup->setStartAndGoalStates(start, goal);
  const auto planner = std::make_shared<ompl::geometric::RRTConnect>(setup->getSpaceInformation());
  planner->setNearestNeighbors<swept::NearestStates>();  // several times as fast as the default
  setup->setPlanner(planner);
  if (setup->solve(10.0) != ompl::base::PlannerStatus::EXACT_SOLUTION) return 1;

  setup->simplifySolution();
  setup->getSolutionPath().printAsMatrix(std::cout);
  for (const auto& segment : swept::certifyPath(setup->getSolutionPath(), *checker)) {
    std::cout << "segment " << toString(segment.verdict) << '\n';
    if (segment.verdict != swept::Verdict::Free) return 2;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc == 7) return plan(argv);
  std::cerr << "usage: " << argv[0] << " ROBOT.urdf ROBOT.srdf SCENE GROUP START GOAL\n";
  return 3;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
