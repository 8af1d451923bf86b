// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/arguments.hpp"
#include "input/task.hpp"
#include "swept/robot_model/input.hpp"

namespace swept {

/// How files are read: with the packages of the command line, and with SWEPT_CACHE. `warnings` must
/// outlive them. Throws UsageError for a --package that is none.
LoadOptions loadOptionsOf(const Arguments& args, Warnings& warnings);

}  // namespace swept
