// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "batch/run_result.hpp"

namespace swept {

/// The totals of one planner and validator on a set of problems, or on all sets.
struct TableRow {
  std::string set;  ///< `total` for all of several
  std::string planner, validator;
  int runs = 0;
  int solved = 0;
  int certified = 0;            ///< solved, every segment proven free
  int withMissed = 0;           ///< solved, with at least one missed collision
  int missed = 0;               ///< segments with a witness of a collision
  int undecided = 0;            ///< segments that are neither
  int stopped = 0;              ///< runs that a worker did not live to the end of
  std::vector<double> times;    ///< s, planning, of the solved ones that have one; ascending
  std::vector<double> lengths;  ///< of the solved ones
};

/// By set, planner and validator, in alphabetic order. The order of the runs does not matter.
std::vector<TableRow> tableRows(const std::vector<RunResult>& runs);

std::string tableText(const std::vector<TableRow>& rows);
Json tableJson(const std::vector<TableRow>& rows);

}  // namespace swept
