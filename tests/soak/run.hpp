// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "memory.hpp"
#include "options.hpp"
#include "refutation.hpp"
#include "tally.hpp"

namespace soak {

/// What came of a soak.
struct Result {
  std::vector<std::string> stages;  ///< names
  std::vector<StageTally> tallies;  ///< by stage
  UpdateCounts updates;
  RefutationCounts judged;
  MemoryReadings resident, heap;
  double seconds = 0.0;           ///< s, of the checks and what goes with them
  double processorSeconds = 0.0;  ///< s, of all threads
  int failures = 0;
  bool interrupted = false;
};

/// The robots of models/, or the one of the options.
std::vector<std::unique_ptr<Stage>> makeStages(const Options& options);

/// Checks on `options.threads` threads, one more that changes the worlds, and one that judges.
/// Disagreements go to `out` as they are found. `interrupted` is asked a hundred times a second.
Result run(const Options& options, const std::vector<std::unique_ptr<Stage>>& stages,
           std::ostream& out, const std::function<bool()>& interrupted);

/// Prints all figures, and adds to the failures what they say against the soak.
void report(Result& result, const Options& options, std::ostream& out);
int exitCode(const Result& result);

/// Asks and judges the one query of the options. The exit code.
int askAgain(const Stage& stage, const Options& options, std::ostream& out);

}  // namespace soak
