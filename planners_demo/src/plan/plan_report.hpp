// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "command_line/arguments.hpp"
#include "input/task.hpp"
#include "output/text_output.hpp"
#include "planning/planning.hpp"
#include "trajectory/timed_trajectory.hpp"

/// How `plan` prints what it has found.
namespace swept {

/// The outcome for one problem.
struct PlanReport {
  const PlanRequest& request;
  const PlanOutcome& outcome;
  const TimedTrajectory* timed = nullptr;  ///< null: none was asked for, or the path is not proven
  bool written = false;                    ///< to the file of -o
};

std::string planText(const Arguments& args, const Checker& checker, const PlanReport& report);
Json planJson(const Arguments& args, const Checker& checker, const PlanReport& report,
              const Warnings& warnings);

}  // namespace swept
