// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "certify/pair_query.hpp"

namespace swept::detail {

/// Gives a witness the nearest points of its two bodies, all of their pieces, at the t of the
/// query. Whoever proves that two bodies are within their margin stops at any two points that are:
/// bodies that overlap may have a witness with a distance.
void takeNearestPoints(const CheckerModel& model, PairQuery& query, Witness& witness);

}  // namespace swept::detail
