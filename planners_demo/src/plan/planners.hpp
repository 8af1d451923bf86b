// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/Planner.h>

#include <optional>
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

/// Longest motion of a planner, in the metric of the space, where OMPL's own default will not do;
/// empty up to seven variables. OMPL's is a fifth of the extent of the space, which grows with
/// their number: arms side by side hardly ever move free by so much at a time. This is a fifth of
/// the root mean square of what the variables reach.
std::optional<double> defaultRange(const ompl::base::StateSpace& space);

/// False for planners that have no such parameter.
bool setRange(ompl::base::Planner& planner, double range);

}  // namespace swept
