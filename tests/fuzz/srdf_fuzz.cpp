// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_input.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/robot.hpp"

using namespace swept;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string kRobot = modelsDir() + "/robots/rook6/rook6.urdf";
  const auto file = fuzz::files().write("robot.srdf", fuzz::textOf(data, size));
  fuzz::mayRefuse([&] { Robot::load(kRobot, file, {}); });
  return 0;
}
