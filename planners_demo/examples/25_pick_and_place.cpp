// SPDX-License-Identifier: BSD-3-Clause
// Three things are moved from one side of a table to the other, past what a noisy depth camera has
// seen; the map is sensed anew after each. The other arm stands in one posture, then in another.
//   example_25_pick_and_place MODELS [FOLDER]
// Writes pick_and_place.json, which `swept verify` checks, and pick_and_place.html, which plays it.
// Exits 0 if all of the task is proven, and each thing stands where it should.
#include <filesystem>
#include <iostream>
#include <random>
#include <vector>

#include "pick_and_place/workplace.hpp"
#include "swept/robot_model/named_states.hpp"
#include "swept/robot_model/work_cell.hpp"

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const std::filesystem::path folder = argc > 2 ? argv[2] : std::filesystem::temp_directory_path();
  const auto robot = swept::loadWorkCell(swept::WorkCell::read(models + "/cells/two_rooks.yaml"));
  const std::vector<Thing> things{{"cup", 16, 0.03, 0.12, {0.5, -0.3}, {0.5, 0.3}},
                                  {"nut", 6, 0.025, 0.08, {0.42, -0.2}, {0.42, 0.2}},
                                  {"block", 4, 0.03, 0.1, {0.55, -0.18}, {0.4, 0.32}}};
  const Hand hand{.arm = "left/arm",
                  .gripper = "left/gripper",
                  .tool = "left/tool",
                  .palm = "left/hand",
                  .fingers = {"left/finger_left", "left/finger_right"},
                  .open = 0.04,
                  .offset = 0.0015};
  const auto posture = [&](const char* group, const char* name) {
    return swept::namedConfiguration(*robot, *robot->findGroup(group), name);
  };
  RecordedTask task(robot, knownWorld(things));
  task.stand("left/arm", posture("left/arm", "home"));
  task.stand("left/gripper", {hand.open});
  task.stand("right/arm", posture("right/arm", "tucked"));
  std::mt19937 random(1);
  task.sense(sensedMap(task, random));

  for (const Thing& thing : things) {
    move(task, thing, hand, random);
    if (thing.name == "cup") task.plan("the other arm", "right/arm", posture("right/arm", "home"));
  }
  task.plan("home", "left/arm", posture("left/arm", "home"));
  task.write(folder, "pick_and_place");

  const swept::CheckedTask checked = swept::verifyTask(folder / "pick_and_place.json");
  bool placed = true;
  for (const Thing& thing : things) {
    const Eigen::Isometry3d& at = task.world().find(thing.name)->parts[0].world_from_shape;
    placed &= (at.translation() - standing(thing.to).translation()).norm() < 1e-4;
  }
  std::cout << task.phases() << " phases, " << task.seconds()
            << " s: " << (checked.holds() ? "all proven" : checked.refusal) << '\n';
  return checked.holds() && placed ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
