// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "batch/run_result.hpp"

namespace swept {

/// Throws UsageError when --log or --csv cannot be written, so that this shows before the work.
/// Makes the folder of the logs.
void requireOutputs(const Arguments& args);

/// The table on stdout, or with --json one object.
void printResults(const Arguments& args, const Json& header, std::vector<RunResult> results);

/// Writes the files of --log and --csv. Throws UsageError.
void writeOutputs(const Arguments& args, const Json& header, std::vector<RunResult> results);

}  // namespace swept
