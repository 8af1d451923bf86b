// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/arguments.hpp"
#include "planning/planning.hpp"

namespace swept {

/// `plan` over all problems of a file, or of one set of it. Options as requirePlanOptions() lets
/// them through.
ExitCode runPlanSets(const Arguments& args, const PlanRequest& request);

}  // namespace swept
