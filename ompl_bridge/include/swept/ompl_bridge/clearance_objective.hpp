// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/objectives/MaximizeMinClearanceObjective.h>

#include <cstdint>
#include <memory>

#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

class WorkspacePool;

/// The pairs that a clearance covers.
enum class ClearanceOf : std::uint8_t {
  World,  ///< pairs of links and attached bodies with the world
  Self,   ///< pairs of links and attached bodies with each other
  All,    ///< whichever is less
};

/// Maximises the least clearance (m) along a path. For a motion it is a proven lower bound for
/// every instant; OMPL's MaximizeMinClearanceObjective tests only the ends. For planners that
/// optimise. Any number of threads may use it.
///
/// By default it is the clearance to the world. Many arms have links that are a constant centimetre
/// apart in every state (forearm and wrist, say). These two then have the least clearance on every
/// path that comes no nearer to an obstacle, and an optimising planner would see no difference
/// between a path along a wall and one through the open. The choice of pairs does not affect
/// validity, which the space information decides.
class CertifiedClearanceObjective : public ompl::base::MaximizeMinClearanceObjective {
 public:
  /// `accuracy`: m, of the bounds for motions; a smaller one needs more work. If the checker has no
  /// pair of the kind, all paths have an infinite clearance. Throws std::invalid_argument as
  /// ValidityChecker does, and for an accuracy that is not a positive number.
  CertifiedClearanceObjective(const ompl::base::SpaceInformationPtr& si,
                              std::shared_ptr<const Checker> checker, double accuracy = 1e-3,
                              ClearanceOf pairs = ClearanceOf::World);
  ~CertifiedClearanceObjective() override;
  /// m. Proven lower bound for a state, as in StateReport; 0 in contact.
  ompl::base::Cost stateCost(const ompl::base::State* state) const override;
  /// m. Proven lower bound for the whole motion between the two states.
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
