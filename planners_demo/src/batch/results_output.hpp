// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "batch/run_result.hpp"

namespace swept {

/// --log and --csv: throws UsageError when they cannot be written; better before the work than
/// after it. Makes the folder of the logs.
void requireOutputs(const Arguments& args);

/// The table on stdout, or with --json one object.
void printResults(const Arguments& args, const Json& header, std::vector<RunResult> results);

/// What --log and --csv ask for. Throws UsageError.
void writeOutputs(const Arguments& args, const Json& header, std::vector<RunResult> results);

}  // namespace swept
