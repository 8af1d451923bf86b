// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "command_line/arguments.hpp"

namespace swept {

/// Names in a robot's files, as written there.
struct RobotNames {
  struct State {
    std::string group, name;
  };
  std::vector<std::string> links;
  std::vector<std::string> joints;  ///< those that move
  std::vector<std::string> groups;
  std::vector<State> states;
};

/// The names in `args.robot` and in its SRDF. It reads no geometry and judges nothing. A file that
/// cannot be read has no names, and neither has a URDF that xacro has to make.
RobotNames robotNames(const Arguments& args);

}  // namespace swept
