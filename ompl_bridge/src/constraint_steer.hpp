// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/SpaceInformation.h>

#include <memory>
#include <vector>

#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/constraint_projection.hpp"

namespace swept::detail {

/// Moves states along where the constraints of a checker hold, by numbers: a validator proves the
/// motions. For one thread.
class ConstraintSteer {
 public:
  /// The space is built as makeStateSpace does for the checker's group.
  ConstraintSteer(const ompl::base::StateSpacePtr& space, const Checker& checker);
  ~ConstraintSteer();
  ConstraintSteer(const ConstraintSteer&) = delete;
  ConstraintSteer& operator=(const ConstraintSteer&) = delete;

  /// Moves a state to where the constraints hold. False: none was found.
  bool project(ompl::base::State* state);
  /// A step from one state towards another, as far as the straight motion keeps the constraints,
  /// and no farther than `range`. False: there is none that comes nearer.
  bool step(const ompl::base::State* from, const ompl::base::State* to, double range,
            ompl::base::State* reached);
  /// The states between two, by steps. False: they do not lead to the second, or are longer than
  /// `longest`. The caller frees the states in either case.
  bool between(const ompl::base::State* from, const ompl::base::State* to, double range,
               double longest, std::vector<ompl::base::State*>& states);

 private:
  bool keeps(const ompl::base::State* from, const ompl::base::State* to);

  ompl::base::StateSpacePtr space_;
  StateConversion conversion_;
  ConstraintProjection projection_;
  ConstraintProjection::Workspace workspace_;
  std::vector<double> q_;
  ompl::base::State* middle_;
};

/// Null: the checker of the space information has no constraints, or is not known.
std::unique_ptr<ConstraintSteer> steerOf(const ompl::base::SpaceInformation& si);

}  // namespace swept::detail
