// SPDX-License-Identifier: BSD-3-Clause
// Is a whole motion between two states free, and what is its least clearance? If it is not free:
// until when is it, and what does it hit?
//   example_06_motion_certificate MODELS
// Exits 0 if the states on the motions, checked one by one, agree.
#include <cmath>
#include <iostream>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/named_states.hpp"
#include "swept/robot_model/named_values.hpp"

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const std::string arm = models + "/robots/rook7/rook7";
  const auto robot = swept::Robot::load(arm + ".urdf", arm + ".srdf");
  const swept::World world = swept::World::load(models + "/scenes/narrow_slot.yaml");
  const swept::Checker checker(robot, "arm", std::make_shared<swept::World>(world));
  swept::Workspace workspace(checker);
  const auto home = swept::namedConfiguration(*robot, checker.group(), "home");
  const auto ready = swept::namedConfiguration(*robot, checker.group(), "ready");
  const auto turned = [&](double angle) {  // rad; the other joints stay
    return swept::configurationOf(*robot, checker.group(), {{"joint1", angle}}, ready);
  };
  const auto from = turned(-0.3), to = turned(0.3);
  bool right = true;

  // Free is proven for every instant. The clearance is an interval around the least distance.
  const auto free = checker.certifyMotion(from, to, workspace);
  const auto clearance = checker.motionClearance(from, to, 1e-3, workspace);
  std::cout << "swing: " << toString(free.verdict) << ", keeps " << clearance.lower
            << " m, comes as near as " << clearance.upper << " m at t = " << clearance.t << '\n';
  double least = INFINITY;
  for (int i = 0; i <= 100; ++i)
    least = std::min(least, checker.clearance(checker.interpolate(from, to, i / 100.0), workspace));
  right &= free.verdict == swept::Verdict::Free && clearance.lower > 0.0;
  right &= clearance.lower <= least && least <= clearance.upper + 1e-3;

  // Collision has a witness: two points that touch at one t. Before `freeUntil` all is proven free.
  const auto hit = checker.certifyMotion(home, ready, workspace);
  std::cout << "home to ready: " << toString(hit.verdict) << ", free until t = " << hit.freeUntil;
  if (!hit.witness) return 1;
  std::cout << ", " << hit.witness->bodyA << " touches " << hit.witness->bodyB
            << " at t = " << hit.witness->t << '\n';
  const auto verdictAt = [&](double t) {
    return checker.checkState(checker.interpolate(home, ready, t), workspace);
  };
  right &= verdictAt(hit.freeUntil) == swept::Verdict::Free;
  right &= verdictAt(hit.witness->t) == swept::Verdict::Collision;
  return right && hit.freeUntil < hit.witness->t ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
