// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "model/pair_model.hpp"
#include "simd/compile/simd_model.hpp"
#include "simd/tables/pair_separation_table.hpp"

namespace swept::detail {

/// All tables that were built for a robot.
struct PairSeparationTables {
  struct Entry {
    int bodyA = 0;
    int bodyB = 0;
    std::shared_ptr<const PairSeparationTable> table;
  };
  std::vector<Entry> entries;
  SharedArray<RobotGeometry> geometry;  ///< that they were built for
};

/// Tables for all of SimdModel::bodyPairs that can have one and are worth it. Built on as many
/// threads as processors, and the same for any number.
std::shared_ptr<const PairSeparationTables> buildPairSeparationTables(const PairModel& model,
                                                                      const SimdModel& simd);

/// Gives each of SimdModel::bodyPairs the table that holds for all of its pairs, if there is one:
/// with the same geometry, and margins that are not larger. A table may contain more pairs.
void chooseTables(const PairModel& model, const PairSeparationTables& tables, SimdModel& simd);

/// Tables for the pairs of a usable model. `like`: null, or that of an earlier version for the same
/// robot, group and reference; its tables are reused, and none are built.
void addTables(const PairModel& model, const SimdModel* like, SimdModel& simd);

}  // namespace swept::detail
