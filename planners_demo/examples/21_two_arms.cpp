// SPDX-License-Identifier: BSD-3-Clause
// Two arms over one table: one moves while the other stands in its way or not, then both at once.
//   example_21_two_arms MODELS
// Exits 0 if the standing arm blocks what is free without it, and both find a proven path together.
#include <iostream>
#include <string>
#include <vector>

#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/robot_model/work_cell.hpp"

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const auto robot = swept::loadWorkCell(swept::WorkCell::read(models + "/cells/two_rooks.yaml"));
  const auto world = std::make_shared<const swept::World>();

  // The right arm, which `left/arm` does not move, stands as `reference` says.
  const swept::Group& right = *robot->findGroup("right/arm");
  const std::vector<double> reaching{0, 1.3, 0, 0.3, 0, 0, 0};  // over the table
  const auto verdictBeside = [&](const std::vector<double>& posture) {
    Eigen::VectorXd reference = robot->defaultState();
    for (std::size_t i = 0; i < posture.size(); ++i) reference[right.variables[i]] = posture[i];
    const swept::Checker left(robot, "left/arm", world, {.reference = reference});
    swept::Workspace workspace(left);
    const auto home = swept::namedConfiguration(*robot, left.group(), "home");
    return left.certifyMotion(home, reaching, workspace).verdict;
  };
  const auto tucked = verdictBeside(swept::namedConfiguration(*robot, right, "tucked"));
  const auto blocked = verdictBeside(reaching);
  std::cout << "beside a tucked arm: " << toString(tucked)
            << ", against a reaching one: " << toString(blocked) << '\n';

  // All 14 joints at once.
  const auto both = std::make_shared<const swept::Checker>(robot, "both", world);
  const auto setup = swept::makeSimpleSetup(both);
  const auto stateOf = [&](const char* name) {
    return swept::namedConfiguration(*robot, both->group(), name);
  };
  swept::setStartAndGoal(*setup, *both, stateOf("ready"), stateOf("tucked"));
  setup->setPlanner(std::make_shared<swept::CertifiedConnect>(setup->getSpaceInformation()));
  if (setup->solve(10.0) != ompl::base::PlannerStatus::EXACT_SOLUTION) return 1;
  for (const auto& segment : swept::certifyPath(setup->getSolutionPath(), *both))
    if (segment.verdict != swept::Verdict::Free) return 2;
  std::cout << "both together: " << setup->getSolutionPath().getStateCount() << " states, proven\n";
  return tucked == swept::Verdict::Free && blocked == swept::Verdict::Collision ? 0 : 3;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 4;
}
