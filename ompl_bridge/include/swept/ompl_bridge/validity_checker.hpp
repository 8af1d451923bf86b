// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>

#include <memory>

#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// Hands workspaces to threads: one is leased for the duration of a call.
class WorkspacePool;

/// isValid: within the bounds of the space and proven free.
///
/// clearance (m): proven lower bound of the least distance, to within tolerance::kDistance and
/// rounding; in contact not more than minus the depth (Checker::signedClearance), which of meshes
/// may be a good deal less; minus infinity for a state of which nothing is known. Whatever the
/// bounds and the margin.
///
/// The overloads with a valid state: of a state that is not valid, they follow the clearance uphill
/// until the state is, if that takes few steps. A state that is valid gets none.
///
/// Any number of threads may call it.
class ValidityChecker : public ompl::base::StateValidityChecker {
 public:
  /// Throws std::invalid_argument unless si's space is built as makeStateSpace does for the
  /// checker's group, and for a world with moving obstacles.
  ValidityChecker(const ompl::base::SpaceInformationPtr& si,
                  std::shared_ptr<const Checker> checker);
  ~ValidityChecker() override;
  /// Asks this checker from now on; see swept::setChecker. No other call may be in flight. Throws
  /// as the constructor, and goes on with the checker that it had then.
  void setChecker(std::shared_ptr<const Checker> checker);
  /// Who is asked; never null.
  const std::shared_ptr<const Checker>& checker() const { return checker_; }
  using ompl::base::StateValidityChecker::clearance;
  using ompl::base::StateValidityChecker::isValid;
  /// See the class. Undecided is not valid.
  bool isValid(const ompl::base::State* state) const override;
  ///@{
  /// See the class; m.
  double clearance(const ompl::base::State* state) const override;
  double clearance(const ompl::base::State* state, ompl::base::State* validState,
                   bool& validStateAvailable) const override;
  ///@}

 private:
  bool findValid(const ompl::base::State* state, ompl::base::State* validState) const;

  std::shared_ptr<const Checker> checker_;
  StateConversion conversion_;
  std::unique_ptr<WorkspacePool> pool_;
};

}  // namespace swept
