// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "batch/run_result.hpp"

namespace swept {

/// A benchmark log as OMPL's tools read it. It holds one experiment, which is one problem.
struct ExperimentLog {
  std::string name;  ///< of the experiment and, with the ending .log, of its file
  std::string text;
};

/// One per problem, in the order of the results, which have to be in the order of their keys.
/// `header` is theirs.
std::vector<ExperimentLog> experimentLogs(const Json& header,
                                          const std::vector<RunResult>& results);

}  // namespace swept
