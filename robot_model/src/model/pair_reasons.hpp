// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "model/pair_model.hpp"

namespace swept::detail {

/// Pairs of collision bodies, the smaller index first, that the SRDF, a joint between the two or a
/// body's touch links exclude.
std::set<std::pair<int, int>> disabledCarriers(const PairModel& model);

/// All pairs of bodies as the Checker lists them.
const PairLists& pairLists(const PairModel& model);

/// See Checker::explain.
std::string explainPair(const PairModel& model, std::string_view bodyA, std::string_view bodyB);

}  // namespace swept::detail
