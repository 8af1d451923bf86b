// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_input.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/path_file.hpp"

using namespace swept;

/// The first byte chooses the format.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto kRobot = Robot::load(modelsDir() + "/robots/rook6_cart/rook6_cart.urdf",
                                         modelsDir() + "/robots/rook6_cart/rook6_cart.srdf", {});
  const Group& group = *kRobot->findGroup("whole_body");
  if (size == 0) return 0;
  const std::string name = data[0] == 'c' ? "path.csv" : data[0] == 'j' ? "path.json" : "path.yaml";
  const auto file = fuzz::files().write(name, fuzz::textOf(data + 1, size - 1));
  fuzz::mayRefuse([&] {
    const auto states = readPath(file, *kRobot, group);
    if (states.empty()) fuzz::fail("a path without a state");
    for (const std::vector<double>& q : states) {
      if (q.size() != group.variables.size()) fuzz::fail("a state of another size");
      for (std::size_t i = 0; i < q.size(); ++i) {
        const Variable& variable = kRobot->variables()[group.variables[i]];
        if (!(q[i] >= variable.lower && q[i] <= variable.upper)) fuzz::fail("outside its limits");
      }
    }
  });
  return 0;
}
