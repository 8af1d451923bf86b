// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "command_line/arguments.hpp"

namespace swept {

/// A URDF as it was read, or written by a program.
struct ExpandedText {
  std::string text;
  std::string name;  ///< what messages call it, with the lines of what was written
};

/// What the program `xacro` (of ROS, looked for on the path) makes of `args.robot` with
/// `args.xacroArguments`. Throws UsageError where it cannot be run or fails.
ExpandedText expandedText(const Arguments& args);

}  // namespace swept
