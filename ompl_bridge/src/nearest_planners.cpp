// SPDX-License-Identifier: BSD-3-Clause
#include <ompl/geometric/planners/rrt/BiTRRT.h>
#include <ompl/geometric/planners/rrt/LBTRRT.h>
#include <ompl/geometric/planners/rrt/LazyLBTRRT.h>
#include <ompl/geometric/planners/rrt/LazyRRT.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTXstatic.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/rrt/pRRT.h>

#include "swept/core/floating_point_environment.hpp"
#include "swept/ompl_bridge/nearest_states.hpp"

namespace swept {
namespace {

namespace og = ompl::geometric;

template <typename Planner>
bool useIn(ompl::base::Planner& planner) {
  auto* const given = dynamic_cast<Planner*>(&planner);
  if (given == nullptr) return false;
  given->template setNearestNeighbors<NearestStates>();
  return true;
}

template <typename... Planners>
bool useInOneOf(ompl::base::Planner& planner) {
  return (useIn<Planners>(planner) || ...);
}

}  // namespace

bool useNearestStates(ompl::base::Planner& planner) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return useNearestStates(planner); });
  }
  if (useInOneOf<og::RRT, og::RRTConnect, og::RRTstar, og::LazyRRT, og::LBTRRT, og::LazyLBTRRT,
                 og::BiTRRT, og::pRRT>(planner))
    return true;
  // RRTsharp is one. Their setup() looks at the objective.
  return planner.getProblemDefinition() != nullptr && useIn<og::RRTXstatic>(planner);
}

}  // namespace swept
