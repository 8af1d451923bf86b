// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/arguments.hpp"
#include "command_line/exit_code.hpp"
#include "output/text_output.hpp"

namespace swept {

/// Whether a file is a model that `swept cover` has written as JSON, rather than a path.
bool isCoverFile(const Json& file);

/// Shows, with the code of robot_model/verify alone, that the model contains the links of the robot
/// of --robot. Throws UsageError without one.
ExitCode verifyCover(const Arguments& args, const Json& cover);

}  // namespace swept
