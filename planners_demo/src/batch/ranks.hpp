// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "batch/worker_process.hpp"

namespace swept {

/// The rank of this process in an MPI job, as the launcher gives it. None: it is not in such a job,
/// or this build is without MPI.
std::optional<int> mpiRank();

/// How the ranks of a job process a list of runs that all of them know.
struct RankedBatch {
  /// Called in a process of its own. It receives all the runs first and then does them.
  WorkerProcess::Life work;
  /// Called on rank 0, before all else: the places in the list that are to be done.
  std::function<std::vector<std::size_t>()> open;
  /// Called on rank 0: takes a line of a results file.
  std::function<void(const std::string& line)> take;
  /// Called on rank 0.
  std::function<void(const std::string& line)> warn;
};

/// Shares the runs among the ranks, by place. Call it while the process has one thread, and once
/// per process. A rank that cannot go on ends the job, with a message and exit code 3.
void runOnRanks(const RankedBatch& batch);

}  // namespace swept
