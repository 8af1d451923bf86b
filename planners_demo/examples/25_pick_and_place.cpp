// SPDX-License-Identifier: BSD-3-Clause
// Three things are moved from one side of a table to the other, past what a noisy depth camera has
// seen; the map is sensed anew after each. The other arm stands in one posture, then in another.
//   example_25_pick_and_place MODELS [FOLDER [PR2]]
// Writes pick_and_place.json, which `swept verify` checks, and pick_and_place.html, which plays it.
// The robot is the cell of two rooks in MODELS, or the PR2 of a folder.
// Exits 0 if all of the task is proven, and each thing stands where it should.
#include <filesystem>
#include <iostream>
#include <random>
#include <vector>

#include "pick_and_place/workers.hpp"

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const std::filesystem::path folder = argc > 2 ? argv[2] : std::filesystem::temp_directory_path();
  const Worker worker = argc > 3 ? pr2(argv[3]) : twoRooks(models);
  const std::vector<Thing> things{{"cup", 16, 0.03, 0.12, {0.2, -0.3}, {0.2, 0.3}},
                                  {"nut", 6, 0.025, 0.08, {0.12, -0.2}, {0.12, 0.2}},
                                  {"block", 4, 0.03, 0.1, {0.25, -0.18}, {0.1, 0.32}}};
  RecordedTask task(worker.robot, knownWorld(worker, things));
  task.stand(worker.hand.arm, worker.start);
  task.stand(worker.hand.gripper, {worker.hand.open});
  task.stand(worker.otherArm, worker.other);
  std::mt19937 random(1);
  task.sense(sensedMap(task, worker, random));

  for (const Thing& thing : things) {
    move(task, thing, worker, random);
    if (thing.name == "cup") task.plan("the other arm", worker.otherArm, worker.otherLater);
  }
  task.plan("home", worker.hand.arm, worker.start);
  task.write(folder, "pick_and_place");

  const swept::CheckedTask checked = swept::verifyTask(folder / "pick_and_place.json");
  bool placed = true;
  for (const Thing& thing : things) {
    const Eigen::Isometry3d& at = task.world().find(thing.name)->parts[0].world_from_shape;
    placed &= (at.translation() - standing(worker, thing.to).translation()).norm() < 1e-4;
  }
  std::cout << task.phases() << " phases, " << task.seconds()
            << " s: " << (checked.holds() ? "all proven" : checked.refusal) << '\n';
  return checked.holds() && placed ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
