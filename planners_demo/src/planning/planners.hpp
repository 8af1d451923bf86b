// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/Planner.h>

#include <string>
#include <string_view>
#include <vector>

namespace swept {

/// Names of the planners makePlanner knows, in alphabetic order.
std::vector<std::string> plannerNames();

/// Full name of a planner given in any case; throws UsageError, listing all, when there is none.
std::string plannerName(std::string_view anyCase);

/// A planner with OMPL's default parameters. `name` as plannerName() returns it.
ompl::base::PlannerPtr makePlanner(std::string_view name,
                                   const ompl::base::SpaceInformationPtr& si);

}  // namespace swept
