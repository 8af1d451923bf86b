// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/Planner.h>

#include <string>
#include <string_view>
#include <vector>

namespace swept {

/// The names that makePlanner() knows, in alphabetic order: CertifiedConnect, and every geometric
/// planner of OMPL that needs nothing but the space.
std::vector<std::string> plannerNames();

/// The full name of a planner given in any case. Throws UsageError, listing all, if there is none.
std::string plannerName(std::string_view anyCase);

/// A planner with OMPL's default parameters, and NearestStates where it takes them. `name` is as
/// plannerName() returns it; throws UsageError for another one. Throws UsageError, too, where the
/// space has continuous joints, or planar or floating ones beside others, and OMPL's informed
/// samples, which the planner needs, do not exist: for ABITstar, AITstar, BITstar, CForest,
/// InformedRRTstar and SORRTstar.
ompl::base::PlannerPtr makePlanner(std::string_view name,
                                   const ompl::base::SpaceInformationPtr& si);

}  // namespace swept
