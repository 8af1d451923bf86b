// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "lanes/joint_table.hpp"

namespace swept::detail {

struct CheckerModel;
struct LaneModel;

/// One for each of LaneModel::bodyPairs; null for bodies that cannot have one, or none that is
/// worth building. Built on as many threads as there are processors, and the same on any number.
std::vector<std::shared_ptr<const JointTable>> buildJointTables(const CheckerModel& model,
                                                                const LaneModel& lanes);

}  // namespace swept::detail
