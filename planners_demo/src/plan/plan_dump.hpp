// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "planning/planning.hpp"
#include "replay/query_dump.hpp"

namespace swept {

/// The ends that cannot be used, and the segments that are not proven.
void dumpFailures(QueryDump& dump, const Checker& checker, const PlanOutcome& outcome);

}  // namespace swept
