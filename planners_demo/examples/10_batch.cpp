// SPDX-License-Identifier: BSD-3-Clause
// Many states, and many motions, at once on all processors: a roadmap's vertices and edges.
//   example_10_batch MODELS
// Exits 0 if one thread that checks them one by one gets the same answers.
#include <algorithm>
#include <iostream>
#include <random>

#include "swept/robot_model/checker.hpp"

constexpr std::size_t kStates = 2000;

// States are consecutive in one array.
std::vector<double> randomStates(const swept::Robot& robot, const swept::Group& group) {
  std::mt19937 random(1);
  std::vector<double> states;
  for (std::size_t i = 0; i < kStates; ++i)
    for (const int index : group.variables) {
      const swept::Variable& variable = robot.variables()[index];
      states.push_back(std::uniform_real_distribution(variable.lower, variable.upper)(random));
    }
  return states;
}

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const std::string arm = models + "/robots/rook7/rook7";
  const auto robot = swept::Robot::load(arm + ".urdf", arm + ".srdf");
  const swept::World world = swept::World::load(models + "/scenes/shelf.yaml");
  const swept::Checker checker(robot, "arm", std::make_shared<swept::World>(world));

  const std::vector<double> states = randomStates(*robot, checker.group());
  std::vector<swept::Verdict> verdicts(kStates);
  checker.checkStates(states, verdicts);
  const auto free = std::ranges::count(verdicts, swept::Verdict::Free);
  std::cout << free << " of " << kStates << " states are free\n";

  // The starts of motions, and their ends: each state to the next one.
  const std::size_t n = checker.dimension();
  const auto from = std::span(states).first(states.size() - n);
  const auto to = std::span(states).subspan(n);
  std::vector<swept::MotionCertificate> motions(kStates - 1);
  checker.certifyMotions(from, to, motions);
  const auto passable =
      std::ranges::count(motions, swept::Verdict::Free, &swept::MotionCertificate::verdict);
  std::cout << passable << " of " << motions.size() << " motions between them are\n";

  swept::Workspace workspace(checker);
  bool same = true;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const auto q = from.subspan(i * n, n);
    same &= checker.checkState(q, workspace) == verdicts[i];
    same &= checker.certifyMotion(q, to.subspan(i * n, n), workspace).verdict == motions[i].verdict;
  }
  return same && free > 0 && passable > 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
