// SPDX-License-Identifier: BSD-3-Clause
#include "plan/plan_dump.hpp"

#include <string>

namespace swept {

void dumpFailures(QueryDump& dump, const Checker& checker, const PlanOutcome& outcome) {
  for (const EndReport& end : outcome.badEnds) dump.state(checker, end.label, end.q, end.verdict);
  for (std::size_t i = 0; i < outcome.segments.size(); ++i)
    dump.motion(checker, "segment " + std::to_string(i + 1), outcome.states[i],
                outcome.states[i + 1], outcome.segments[i].certificate);
}

}  // namespace swept
