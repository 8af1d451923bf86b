// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_input.hpp"
#include "swept/robot_model/robot.hpp"
#include "urdf_text.hpp"

using namespace swept;

namespace {

/// Names of rook6, and balls for its links: it is read anew for each input, and meshes take long.
std::string robotText() {
  std::string text = "<robot name='rook6'>";
  for (const char* link : {"base_link", "shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2",
                           "wrist_3", "bracket", "tool"})
    text += std::string("<link name='") + link +
            "'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>";
  const std::string way = "<origin xyz='0 0 0.3'/>";
  const auto add = [&](const char* name, const char* type, const char* parent, const char* child,
                       const std::string& rest) {
    text += test::joint(name, type, parent, child, way + rest);
  };
  const std::string pitch = test::limited("0 1 0", -3.0, 3.0);
  add("shoulder_pan", "continuous", "base_link", "shoulder", "<axis xyz='0 0 1'/>");
  add("shoulder_lift", "revolute", "shoulder", "upper_arm", pitch);
  add("elbow", "revolute", "upper_arm", "forearm", pitch);
  add("wrist_1_joint", "revolute", "forearm", "wrist_1", pitch);
  add("wrist_2_joint", "revolute", "wrist_1", "wrist_2", test::limited("0 0 1", -3.0, 3.0));
  add("wrist_3_joint", "continuous", "wrist_2", "wrist_3", "<axis xyz='0 1 0'/>");
  add("bracket_mount", "fixed", "wrist_3", "bracket", "");
  add("tool_mount", "fixed", "bracket", "tool", "");
  return text + "</robot>";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto kRobot = fuzz::files().write("robot.urdf", robotText());
  const auto file = fuzz::files().write("robot.srdf", fuzz::textOf(data, size));
  fuzz::mayRefuse([&] { Robot::load(kRobot, file, {}); });
  return 0;
}
