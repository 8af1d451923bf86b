// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/exit_code.hpp"
#include "input/xacro.hpp"

/// For where no other program can be run.
namespace swept {

ExpandedText expandedText(const Arguments& args) {
  throw UsageError("--xacro: xacro cannot be run here, and '" + args.robot + "' needs it");
}

}  // namespace swept
