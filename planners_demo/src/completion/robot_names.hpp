// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "command_line/arguments.hpp"

namespace swept {

/// Names in a robot's files, as they stand there.
struct RobotNames {
  struct State {
    std::string group, name;
  };
  std::vector<std::string> links;
  std::vector<std::string> joints;  ///< those that move
  std::vector<std::string> groups;
  std::vector<State> states;
};

/// Of `args.robot` and the SRDF that goes with it. Geometry is not read, nothing is judged, and
/// what cannot be read has no names: a URDF that xacro has to make has none of its own.
RobotNames robotNames(const Arguments& args);

}  // namespace swept
