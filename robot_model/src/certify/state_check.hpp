// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "certify/pair_query.hpp"

namespace swept::detail {

/// Verdict on one state; stops at the first contact.
Verdict checkState(const CheckerModel& model, std::span<const double> q, WorkspaceData& workspace);

/// One verdict for each of the states, which follow each other in `states`.
void checkStates(const CheckerModel& model, std::span<const double> states,
                 std::span<Verdict> verdicts, WorkspaceData& workspace);

/// All violating pairs, and the clearance.
StateReport reportState(const CheckerModel& model, std::span<const double> q,
                        WorkspaceData& workspace);

/// m. Proven lower bound of the least distance over all pairs.
double stateClearance(const CheckerModel& model, std::span<const double> q,
                      WorkspaceData& workspace);

}  // namespace swept::detail
