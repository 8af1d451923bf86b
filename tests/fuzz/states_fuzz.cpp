// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/exit_code.hpp"
#include "fuzz_input.hpp"
#include "input/states.hpp"
#include "models_dir.hpp"

using namespace swept;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto kRobot = Robot::load(modelsDir() + "/robots/rook6_cart/rook6_cart.urdf",
                                         modelsDir() + "/robots/rook6_cart/rook6_cart.srdf", {});
  const Group& group = *kRobot->findGroup("whole_body");
  try {
    const std::string text(fuzz::textOf(data, size));
    const std::vector<double> q =
        readState(*kRobot, group, text, "state 1", [](const std::string&) {});
    for (std::size_t i = 0; i < q.size(); ++i) {
      const Variable& variable = kRobot->variables()[group.variables[i]];
      if (!(q[i] >= variable.lower && q[i] <= variable.upper)) fuzz::fail("outside its limits");
    }
  } catch (const UsageError&) {
    return 0;
  }
  return 0;
}
