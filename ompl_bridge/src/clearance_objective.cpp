// SPDX-License-Identifier: BSD-3-Clause
#include "swept/ompl_bridge/clearance_objective.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "number_text.hpp"
#include "preconditions.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "workspace_pool.hpp"

namespace swept {

namespace {

const char* descriptionOf(ClearanceOf pairs) {
  switch (pairs) {
    case ClearanceOf::World:
      return "Proven least clearance of the motions to the world";
    case ClearanceOf::Self:
      return "Proven least clearance of the robot's bodies to each other";
    case ClearanceOf::All:
      break;
  }
  return "Proven least clearance of the motions";
}

ClearanceQuery queryOf(ClearanceOf pairs) {
  switch (pairs) {
    case ClearanceOf::World:
      return ClearanceQuery::World;
    case ClearanceOf::Self:
      return ClearanceQuery::Self;
    case ClearanceOf::All:
      break;
  }
  return ClearanceQuery::Least;
}

}  // namespace

CertifiedClearanceObjective::CertifiedClearanceObjective(const ompl::base::SpaceInformationPtr& si,
                                                         std::shared_ptr<const Checker> checker,
                                                         double accuracy, ClearanceOf pairs)
    : MaximizeMinClearanceObjective(si),
      checker_(detail::requireChecker(std::move(checker), *si->getStateSpace())),
      conversion_(checker_->robot(), checker_->group()),
      accuracy_(accuracy),
      pairs_(pairs),
      pool_(std::make_unique<WorkspacePool>(*checker_)) {
  if (!(accuracy > 0.0) || !std::isfinite(accuracy)) {
    throw std::invalid_argument("CertifiedClearanceObjective: accuracy " +
                                detail::numberText(accuracy) +
                                " m must be a finite number greater than zero");
  }
  description_ = descriptionOf(pairs);
}

CertifiedClearanceObjective::~CertifiedClearanceObjective() = default;

ompl::base::Cost CertifiedClearanceObjective::stateCost(const ompl::base::State* state) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, state] { return CertifiedClearanceObjective::stateCost(state); });
  }
  const WorkspacePool::Lease scratch = pool_->lease();
  conversion_.toConfiguration(state, scratch->from);
  if (pairs_ == ClearanceOf::All)
    return ompl::base::Cost(checker_->clearance(scratch->from, scratch->workspace));
  const StateReport report = checker_->reportState(scratch->from, scratch->workspace);
  return ompl::base::Cost(pairs_ == ClearanceOf::World ? report.world.clearance
                                                       : report.self.clearance);
}

ompl::base::Cost CertifiedClearanceObjective::motionCost(const ompl::base::State* s1,
                                                         const ompl::base::State* s2) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, s1, s2] { return CertifiedClearanceObjective::motionCost(s1, s2); });
  }
  const WorkspacePool::Lease scratch = pool_->lease();
  conversion_.toConfiguration(s1, scratch->from);
  conversion_.toConfiguration(s2, scratch->to);
  return ompl::base::Cost(checker_
                              ->motionClearance(scratch->from, scratch->to, accuracy_,
                                                scratch->workspace, queryOf(pairs_))
                              .lower);
}

}  // namespace swept
