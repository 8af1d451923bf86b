// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "batch/run_result.hpp"
#include "input/task.hpp"
#include "planning/planning.hpp"
#include "replay/query_dump.hpp"

namespace swept {

/// All that the runs of a batch share; made once, before there are workers.
struct Batch {
  const Arguments* args = nullptr;
  Model model;
  std::string group;
  std::shared_ptr<const ProblemFile> problems;
};

/// Does runs, one after the other, in a process of its own. A result does not depend on the runs
/// before it.
class Worker {
 public:
  /// Builds a checker, on threads. Throws UsageError as makeChecker does.
  Worker(const Batch& batch, Warnings::Taker warnings);
  RunResult run(const RunKey& key);

 private:
  const std::shared_ptr<const Checker>& checkerOf(const PlanningProblem& problem);
  void dump(const RunKey& key, const PlanOutcome& outcome);

  const Batch& batch_;
  const Group& group_;
  Warnings warnings_;
  QueryDump dump_;
  std::shared_ptr<const Checker> like_;
  /// The last problem and its checker: consecutive runs of a batch often have the same.
  std::string set_;
  int index_ = 0;
  std::shared_ptr<const Checker> checker_;
};

}  // namespace swept
