// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/geometric/SimpleSetup.h>

#include <cstdint>
#include <memory>

#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/configuration.hpp"

namespace swept {

/// How motions are checked.
enum class MotionCheck : std::uint8_t {
  Certified,  ///< CertifiedMotionValidator: valid means proven free
  /// OMPL's DiscreteMotionValidator over the same ValidityChecker: at the space's resolution, for
  /// comparison. What it calls valid may collide between its samples.
  Discrete,
};

/// Of makeSimpleSetup.
struct SetupOptions {
  StateSpaceOptions space = {};                  ///< limits and weights
  MotionCheck motions = MotionCheck::Certified;  ///< who says that a motion is valid
};

/// One call: space, checker and validator of a group, ready for start, goal and planner.
/// Throws std::invalid_argument without a checker, and as makeStateSpace and ValidityChecker do.
ompl::geometric::SimpleSetupPtr makeSimpleSetup(std::shared_ptr<const Checker> checker,
                                                const SetupOptions& options = {});

/// The world has changed: ValidityChecker and CertifiedMotionValidator of the space information ask
/// `checker` from now on, a version (withReplaced, withBody ...) of the one before or any other of
/// the same robot and group. Space, space information, planners and their roadmaps stay as they
/// are. No planner may run meanwhile, and no other thread ask.
///
/// What a planner has found so far was valid in the world before: certifyEdges() says which edges
/// of a roadmap still are, LazyPRM::clearValidity() lets a lazy roadmap ask again, and other
/// planners are to be cleared. Objectives and goals keep the checker that they were made with.
///
/// Throws std::invalid_argument when the space information has neither of the two, and as their
/// constructors; both go on with the checker before then.
void setChecker(const ompl::base::SpaceInformation& si, std::shared_ptr<const Checker> checker);

/// Start and goal of a setup, in place of those that it had, as configurations of the checker's
/// group. A value at most tolerance::kLimit beyond a bound of the space is taken to that, with a
/// warning to OMPL's console: the path begins and ends at the bound. Throws std::invalid_argument
/// when the setup's space is not of that group, and unless either configuration has a value for
/// each of the group's variables; the setup stays as it was then.
void setStartAndGoal(ompl::geometric::SimpleSetup& setup, const Checker& checker,
                     ConfigurationView start, ConfigurationView goal);

}  // namespace swept
