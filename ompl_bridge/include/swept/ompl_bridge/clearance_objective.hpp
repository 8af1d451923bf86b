// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/objectives/MaximizeMinClearanceObjective.h>

#include <memory>

#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

class WorkspacePool;

/// The least clearance (m) along a path is to be as large as possible; of a motion it is a proven
/// lower bound for every instant, where OMPL's MaximizeMinClearanceObjective looks at the ends
/// only. For planners that optimise; any number of threads may ask.
class CertifiedClearanceObjective : public ompl::base::MaximizeMinClearanceObjective {
 public:
  /// `accuracy`: m, of the bounds of motions: the smaller, the more work. Throws
  /// std::invalid_argument as ValidityChecker, and for an accuracy that is not a positive number.
  CertifiedClearanceObjective(const ompl::base::SpaceInformationPtr& si,
                              std::shared_ptr<const Checker> checker, double accuracy = 1e-3);
  ~CertifiedClearanceObjective() override;
  /// m, Checker::clearance of the state: 0 in contact.
  ompl::base::Cost stateCost(const ompl::base::State* state) const override;
  /// m, proven for the whole motion between the two states.
  ompl::base::Cost motionCost(const ompl::base::State* s1,
                              const ompl::base::State* s2) const override;

 private:
  std::shared_ptr<const Checker> checker_;
  StateConversion conversion_;
  double accuracy_;
  std::unique_ptr<WorkspacePool> pool_;
};

}  // namespace swept
