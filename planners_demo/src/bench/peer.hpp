// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/arguments.hpp"

namespace swept {

/// Throws UsageError for `--against fcl` without FCL in this build, or with a margin above 0.
void requirePeer(const Arguments& args);

}  // namespace swept
