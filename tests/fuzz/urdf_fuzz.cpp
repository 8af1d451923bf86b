// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_input.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/visual_model.hpp"

using namespace swept;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::files().write("robot.urdf", fuzz::textOf(data, size));
  bool isRobot = false;
  fuzz::mayRefuse([&] {
    Robot::load(file, "", {});
    isRobot = true;
  });
  // What a robot looks like is never refused, whatever is wrong with it.
  if (isRobot)
    static_cast<void>(VisualModel::load(file));
  else
    fuzz::mayRefuse([&] { static_cast<void>(VisualModel::load(file)); });
  return 0;
}
