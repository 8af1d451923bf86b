// SPDX-License-Identifier: BSD-3-Clause
// motion ROBOT.urdf SCENE.yaml: a motion that is free and one that is not, by the checker and by
// OMPL's motion validator. Exit code 1 where the two, or the answers, are not as expected.
#include <exception>
#include <iostream>
#include <memory>

#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/robot_model/named_values.hpp"
#include "swept/robot_model/path_clearance.hpp"

namespace {

bool validInOmpl(const ompl::geometric::SimpleSetup& setup, const swept::Checker& checker,
                 swept::ConfigurationView from, swept::ConfigurationView to) {
  const swept::StateConversion conversion(checker.robot(), checker.group());
  ompl::base::ScopedState<> a(setup.getStateSpace()), b(setup.getStateSpace());
  conversion.toState(from, a.get());
  conversion.toState(to, b.get());
  return setup.getSpaceInformation()->checkMotion(a.get(), b.get());
}

int certify(char** argv) {
  const auto robot =
      swept::Robot::load(argv[1], std::filesystem::path(argv[1]).replace_extension(".srdf"));
  const auto world = std::make_shared<const swept::World>(swept::World::load(argv[2]));
  const auto checker = std::make_shared<const swept::Checker>(robot, "arm", world);
  const auto setup = swept::makeSimpleSetup(checker);
  swept::Workspace workspace(*checker);

  const auto home = swept::namedConfiguration(*robot, checker->group(), "home");
  const auto ready = swept::namedConfiguration(*robot, checker->group(), "ready");
  const auto near = swept::configurationOf(*robot, checker->group(), {{"joint1", 0.01}}, home);
  const auto nearby = checker->certifyMotion(home, near, workspace);
  const auto far = checker->certifyMotion(home, ready, workspace);
  std::cout << "nearby " << toString(nearby.verdict) << ", far " << toString(far.verdict)
            << ", free until " << far.freeUntil << '\n';
  const auto keeps = swept::pathClearance(*checker, {home, near}, 1e-3, workspace);
  const bool right = keeps.world.lower > 0.0 && keeps.segment == 0 &&
                     nearby.verdict == swept::Verdict::Free && nearby.freeUntil == 1.0 &&
                     far.verdict == swept::Verdict::Collision && far.witness.has_value();
  const bool same =
      validInOmpl(*setup, *checker, home, near) && !validInOmpl(*setup, *checker, home, ready);
  return right && same ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    return certify(argv);
  } catch (const std::exception& problem) {
    std::cout << problem.what() << '\n';
    return 2;
  }
}
