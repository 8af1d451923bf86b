// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "arguments.hpp"
#include "exit_code.hpp"
#include "planning.hpp"

/// The subcommands. Each prints its results on stdout and throws InputError or UsageError.
namespace swept {

ExitCode runInfo(const Arguments& args);
ExitCode runCheck(const Arguments& args);
ExitCode runMotion(const Arguments& args);
ExitCode runPlan(const Arguments& args);
ExitCode runAcm(const Arguments& args);
ExitCode runReplay(const Arguments& args);
ExitCode runBenchEdges(const Arguments& args);
/// `plan` over all problems of a file, or of one set of it.
ExitCode runPlanSets(const Arguments& args, const PlanRequest& request);

}  // namespace swept
