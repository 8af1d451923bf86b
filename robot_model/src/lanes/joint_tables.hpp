// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "certify/checker_model.hpp"
#include "lanes/joint_table.hpp"

namespace swept::detail {

/// All tables that were built for a robot.
struct JointTables {
  struct Entry {
    int bodyA = 0;
    int bodyB = 0;
    std::shared_ptr<const JointTable> table;
  };
  std::vector<Entry> entries;
  SharedArray<RobotGeometry> geometry;  ///< that they are about
};

/// For all of LaneModel::bodyPairs that can have one and are worth it. Built on as many threads as
/// there are processors, and the same on any number.
std::shared_ptr<const JointTables> buildJointTables(const CheckerModel& model,
                                                    const LaneModel& lanes);

/// Gives each of LaneModel::bodyPairs the table that holds for all of its pairs, if there is one:
/// the geometry is the same, and the margins are not larger. A table may know of more pairs.
void chooseTables(const CheckerModel& model, const JointTables& tables, LaneModel& lanes);

}  // namespace swept::detail
