// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "preconditions.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "workspace_pool.hpp"

namespace swept {

ValidityChecker::ValidityChecker(const ompl::base::SpaceInformationPtr& si,
                                 std::shared_ptr<const Checker> checker)
    : StateValidityChecker(si),
      checker_(detail::requireChecker(std::move(checker), *si->getStateSpace())),
      conversion_(checker_->robot(), checker_->group()),
      pool_(std::make_unique<WorkspacePool>(*checker_)) {
  specs_.clearanceComputationType =
      ompl::base::StateValidityCheckerSpecs::ClearanceComputationType::BOUNDED_APPROXIMATE;
}

ValidityChecker::~ValidityChecker() = default;

bool ValidityChecker::isValid(const ompl::base::State* state) const {
  // OMPL's bounds let NaN through; checkState does not.
  if (!si_->satisfiesBounds(state)) return false;
  const WorkspacePool::Lease scratch = pool_->lease();
  conversion_.toConfiguration(state, scratch->from);
  return checker_->checkState(scratch->from, scratch->workspace) == Verdict::Free;
}

double ValidityChecker::clearance(const ompl::base::State* state) const {
  const WorkspacePool::Lease scratch = pool_->lease();
  conversion_.toConfiguration(state, scratch->from);
  return checker_->clearance(scratch->from, scratch->workspace);
}

}  // namespace swept
