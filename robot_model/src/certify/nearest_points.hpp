// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "certify/pair_query.hpp"

namespace swept::detail {

/// Replaces a witness's points by the nearest points of its two bodies, over all of their pieces,
/// at its t and configuration. A proof of contact stops at any two points within the margin, so
/// bodies that overlap may have a witness with a distance.
void takeNearestPoints(const CheckerModel& model, PairQuery& query, WorkspaceData& workspace,
                       Witness& witness);

}  // namespace swept::detail
