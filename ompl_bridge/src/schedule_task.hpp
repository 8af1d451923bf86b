// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "space_time_search.hpp"
#include "swept/ompl_bridge/schedule_plan.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept::detail {

/// A task as the search needs it.
struct OwnTask {
  std::vector<std::string> names;  ///< of its variables
  OwnSpace space;
  Eigen::VectorXd start;
  std::vector<Eigen::VectorXd> goals;
};

/// Throws std::invalid_argument with the message, after `planSchedule: `, unless this holds.
void requirePlan(bool holds, const std::string& message);

/// The task with this index. Throws std::invalid_argument for what planSchedule() does not allow of
/// one.
OwnTask readTask(const Checker& checker, const ScheduleTask& task, std::size_t index);

}  // namespace swept::detail
