// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/arguments.hpp"
#include "command_line/exit_code.hpp"
#include "output/text_output.hpp"

namespace swept {

/// Whether what a file has is a task: there are phases.
bool isTask(const Json& file);

/// `swept verify` of a task. Throws UsageError for options that only a path has.
ExitCode runVerifyTask(const Arguments& args, const Json& task);

}  // namespace swept
