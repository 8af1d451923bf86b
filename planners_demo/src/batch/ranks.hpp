// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "batch/worker_process.hpp"

namespace swept {

/// Which one of an MPI job's processes this is, as the launcher says; none: it is no such process,
/// or this build is without MPI.
std::optional<int> mpiRank();

/// What the ranks of a job do with a list of runs that all of them know.
struct RankedBatch {
  /// In a process of its own: does the runs it is given, once it has been given all.
  WorkerProcess::Life work;
  /// On rank 0, before all else: the places in the list that are to be done.
  std::function<std::vector<std::size_t>()> open;
  /// On rank 0: a line of a results file.
  std::function<void(const std::string& line)> take;
  /// On rank 0.
  std::function<void(const std::string& line)> warn;
};

/// Shares the runs among the ranks, by place. Must be called while the process has one thread. A
/// rank that cannot go on ends the job, with a message and exit code 3. Once per process.
void runOnRanks(const RankedBatch& batch);

}  // namespace swept
