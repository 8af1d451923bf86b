// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "batch/worker.hpp"
#include "batch/worker_process.hpp"

namespace swept {

/// Does the runs of a batch in separate processes. Whatever one of them does, the others go on.
class WorkerPool {
 public:
  struct Listener {
    std::function<void(const RunResult&)> done;
    std::function<void(const std::string& line)> warning;
    std::function<void()> tick;  ///< a few times a second
  };

  /// `keys` have to outlive this. A run that takes longer than `hardLimit` (s) is stopped.
  WorkerPool(const Interrupt& interrupt, const Batch& batch, const std::vector<RunKey>& keys,
             double hardLimit)
      : interrupt_(interrupt), batch_(batch), keys_(keys), hardLimit_(hardLimit) {}

  /// Does all runs at `places` in the keys, in this order, `jobs` at a time. False: interrupted; no
  /// worker is left then. Call it while the process has one thread. Throws UsageError when a worker
  /// cannot work at all.
  bool run(const std::vector<std::size_t>& places, int jobs, const Listener& listener);

 private:
  void serve(const WorkerLink& link) const;
  void employ(std::size_t jobs);
  void await(const Listener& listener);
  void take(WorkerProcess& worker, const Listener& listener);
  void lose(WorkerProcess& worker, const std::string& how, const Listener& listener);
  bool isLate(const WorkerProcess& worker) const;

  const Interrupt& interrupt_;
  const Batch& batch_;
  const std::vector<RunKey>& keys_;
  double hardLimit_;
  std::vector<WorkerProcess> workers_;
  std::vector<std::size_t> waiting_;  ///< the next one last
  std::size_t done_ = 0;
};

}  // namespace swept
