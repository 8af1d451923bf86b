// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/objectives/MaximizeMinClearanceObjective.h>

#include <cstdint>
#include <memory>

#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

class WorkspacePool;

/// Of which pairs a clearance is.
enum class ClearanceOf : std::uint8_t {
  World,  ///< of links and attached bodies with the world
  Self,   ///< of links and attached bodies with each other
  All,    ///< whichever is less
};

/// The least clearance (m) along a path is to be as large as possible; of a motion it is a proven
/// lower bound for every instant, where OMPL's MaximizeMinClearanceObjective looks at the ends
/// only. For planners that optimise; any number of threads may ask.
///
/// It is that to the world unless told otherwise. Many arms have links that are a constant
/// centimetre apart in every state (forearm and wrist, say): the least of all pairs is that of
/// those two on every path that comes no nearer to an obstacle, so that an optimising planner sees
/// no difference between a path along a wall and one through the open. Which pairs count says
/// nothing of what is valid: that is the space information's.
class CertifiedClearanceObjective : public ompl::base::MaximizeMinClearanceObjective {
 public:
  /// `accuracy`: m, of the bounds of motions: the smaller, the more work. Where the checker has no
  /// pair of the kind, all paths have an infinite clearance. Throws std::invalid_argument as
  /// ValidityChecker, and for an accuracy that is not a positive number.
  CertifiedClearanceObjective(const ompl::base::SpaceInformationPtr& si,
                              std::shared_ptr<const Checker> checker, double accuracy = 1e-3,
                              ClearanceOf pairs = ClearanceOf::World);
  ~CertifiedClearanceObjective() override;
  /// m, as of StateReport: a proven lower bound; 0 in contact.
  ompl::base::Cost stateCost(const ompl::base::State* state) const override;
  /// m, proven for the whole motion between the two states.
  ompl::base::Cost motionCost(const ompl::base::State* s1,
                              const ompl::base::State* s2) const override;

 private:
  std::shared_ptr<const Checker> checker_;
  StateConversion conversion_;
  double accuracy_;
  ClearanceOf pairs_;
  std::unique_ptr<WorkspacePool> pool_;
};

}  // namespace swept
