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

/// isValid is true if the state is within the bounds of the space and proven free.
///
/// clearance (m) is a proven lower bound of the least distance, to within tolerance::kDistance and
/// rounding. In contact it is at most minus the depth (Checker::signedClearance); for meshes it may
/// be much less. It is minus infinity if nothing is known. It ignores the bounds and the margin.
///
/// The overloads with a valid state follow the clearance uphill from an invalid state until it is
/// valid, if that takes few steps. For a valid state they return none.
///
/// Any number of threads may call it.
class ValidityChecker : public ompl::base::StateValidityChecker {
 public:
  /// Throws std::invalid_argument unless si's space is built as makeStateSpace does for the
  /// checker's group, and for a world with moving obstacles.
  ValidityChecker(const ompl::base::SpaceInformationPtr& si,
                  std::shared_ptr<const Checker> checker);
  ~ValidityChecker() override;
  /// Uses this checker from now on; see swept::setChecker. No other call may be running. Throws as
  /// the constructor does, and then keeps the old checker.
  void setChecker(std::shared_ptr<const Checker> checker);
  /// The checker in use; never null.
  const std::shared_ptr<const Checker>& checker() const { return checker_; }
  using ompl::base::StateValidityChecker::clearance;
  using ompl::base::StateValidityChecker::isValid;
  /// See the class. Undecided counts as not valid.
  bool isValid(const ompl::base::State* state) const override;
  ///@{
  /// m; see the class.
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
