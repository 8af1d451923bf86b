// SPDX-License-Identifier: BSD-3-Clause
#include <ompl/base/ScopedState.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "preconditions.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/ompl_bridge/validity_checker.hpp"
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
  specs_.hasValidDirectionComputation = true;
}

ValidityChecker::~ValidityChecker() = default;

void ValidityChecker::setChecker(std::shared_ptr<const Checker> checker) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { setChecker(std::move(checker)); });
  }
  checker = detail::requireChecker(std::move(checker), *si_->getStateSpace());
  auto pool = std::make_unique<WorkspacePool>(*checker);
  conversion_ = StateConversion(checker->robot(), checker->group());
  pool_ = std::move(pool);
  checker_ = std::move(checker);
}

bool ValidityChecker::isValid(const ompl::base::State* state) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, state] { return ValidityChecker::isValid(state); });
  }
  // OMPL's bounds let NaN through; checkState does not.
  if (!si_->satisfiesBounds(state)) return false;
  const WorkspacePool::Lease scratch = pool_->lease();
  conversion_.toConfiguration(state, scratch->from);
  return checker_->checkState(scratch->from, scratch->workspace) == Verdict::Free;
}

double ValidityChecker::clearance(const ompl::base::State* state) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, state] { return ValidityChecker::clearance(state); });
  }
  const WorkspacePool::Lease scratch = pool_->lease();
  conversion_.toConfiguration(state, scratch->from);
  const double apart = checker_->clearance(scratch->from, scratch->workspace);
  return apart > 0.0 ? apart : checker_->signedClearance(scratch->from, scratch->workspace).lower;
}

double ValidityChecker::clearance(const ompl::base::State* state, ompl::base::State* validState,
                                  bool& validStateAvailable) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, state, validState] {
      return ValidityChecker::clearance(state, validState, validStateAvailable);
    });
  }
  validStateAvailable = !isValid(state) && findValid(state, validState);
  return clearance(state);
}

// The steps would be enough if the clearance were linear, with some to spare. Its gradient is only
// that of the nearest or deepest pair, which may change after each step.
bool ValidityChecker::findValid(const ompl::base::State* state,
                                ompl::base::State* validState) const {
  constexpr int kSteps = 30;
  constexpr double kFarthest = 0.3;  // rad or m, of one step
  constexpr double kMore = 1.1;
  ompl::base::ScopedState<> found(si_->getStateSpace(), state);
  ompl::base::State* const there = found.get();
  si_->enforceBounds(there);
  if (isValid(there)) {
    si_->copyState(validState, there);
    return true;
  }
  const WorkspacePool::Lease scratch = pool_->lease();
  const CheckerOptions& options = checker_->options();
  const double margin = std::max(options.marginOf(true), options.marginOf(false));
  const double wanted = margin + 2.0 * options.tolerance;
  for (int i = 0; i < kSteps; ++i) {
    conversion_.toConfiguration(there, scratch->from);
    const SignedClearance now =
        checker_->signedClearance(scratch->from, scratch->workspace, scratch->gradient);
    Eigen::Map<Eigen::VectorXd> q(scratch->from.data(), conversion_.dimension());
    const Eigen::Map<const Eigen::VectorXd> gradient(scratch->gradient.data(), q.size());
    const double slope = gradient.norm();
    if (!(slope > 0.0) || !std::isfinite(now.lower)) return false;
    const double step = kMore * std::max(wanted - now.lower, wanted) / slope;
    q += std::min(step, kFarthest) / slope * gradient;
    conversion_.toState(scratch->from, there);
    si_->enforceBounds(there);
    if (!isValid(there)) continue;
    si_->copyState(validState, there);
    return true;
  }
  return false;
}

}  // namespace swept
