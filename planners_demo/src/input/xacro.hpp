// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "command_line/arguments.hpp"

namespace swept {

/// A URDF as read from a file, or as written by a program.
struct ExpandedText {
  std::string text;
  std::string name;  ///< what messages call it, with the lines of what was written
};

/// The output of the program `xacro` (of ROS, looked for on the path) for `args.robot` with
/// `args.xacroArguments`. Throws UsageError where it cannot be run or fails.
ExpandedText expandedText(const Arguments& args);

}  // namespace swept
