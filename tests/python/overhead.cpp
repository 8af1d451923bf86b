// SPDX-License-Identifier: BSD-3-Clause
// The C++ side of overhead.py.
//   swept_python_overhead ROBOT.urdf GROUP SCENE < states
// The states are lines of numbers in hexadecimal. Prints the s of one query, the least of several
// rounds: of check_state and certify_motion, one by one and in batches.
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>

#include "swept/robot_model/checker.hpp"

namespace {

template <typename Work>
void print(const char* name, std::size_t queries, const Work& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 15; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    least = std::min(least, spent.count() / static_cast<double>(queries));
  }
  std::cout << name << ' ' << least << '\n';
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4) return 2;
  const auto robot = swept::Robot::load(argv[1], swept::Robot::srdfBeside(argv[1]));
  const auto world = std::make_shared<const swept::World>(swept::World::load(argv[3]));
  const swept::Checker checker(robot, argv[2], world);
  swept::Workspace workspace(checker);
  std::vector<double> states;
  for (std::string word; std::cin >> word;) states.push_back(std::strtod(word.c_str(), nullptr));
  const auto n = static_cast<std::size_t>(checker.dimension());
  const std::size_t count = states.size() / n;
  const std::span<const double> all(states);
  constexpr std::size_t kFew = 1000;

  print("check_state", kFew, [&] {
    for (std::size_t i = 0; i < kFew; ++i) checker.checkState(all.subspan(i * n, n), workspace);
  });
  print("certify_motion", kFew, [&] {
    for (std::size_t i = 0; i < kFew; ++i)
      checker.certifyMotion(all.subspan(i * n, n), all.subspan((i + 1) * n, n), workspace);
  });
  print("check_states", count, [&] {
    std::vector<swept::Verdict> verdicts(count);
    checker.checkStates(states, verdicts);
  });
  print("certify_motions", count - 1, [&] {
    std::vector<swept::MotionCertificate> certificates(count - 1);
    checker.certifyMotions(all.first(states.size() - n), all.subspan(n), certificates);
  });
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
