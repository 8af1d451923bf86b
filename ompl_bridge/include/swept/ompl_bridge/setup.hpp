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
  /// OMPL's DiscreteMotionValidator over the same ValidityChecker, at the space's resolution, for
  /// comparison. A motion that it calls valid may collide between its samples.
  Discrete,
};

/// Options of makeSimpleSetup.
struct SetupOptions {
  StateSpaceOptions space = {};                  ///< limits and weights
  MotionCheck motions = MotionCheck::Certified;  ///< the motion validator
};

/// Makes space, checker and validator of a group in one call, ready for start, goal and planner.
/// Throws std::invalid_argument without a checker, and as makeStateSpace and ValidityChecker do.
ompl::geometric::SimpleSetupPtr makeSimpleSetup(std::shared_ptr<const Checker> checker,
                                                const SetupOptions& options = {});

/// Call it after a change of the world. ValidityChecker and CertifiedMotionValidator of the space
/// information use `checker` from now on: a version (withReplaced, withBody ...) of the old one or
/// any other of the same robot and group. Space, space information, planners and their roadmaps
/// stay as they are. Meanwhile no planner may run, and no other thread may query.
///
/// Earlier results of a planner were valid in the old world. certifyEdges() says which edges of a
/// roadmap still are, and LazyPRM::clearValidity() makes a lazy roadmap ask again. Clear other
/// planners. Objectives and goals keep the checker that they were made with.
///
/// Throws std::invalid_argument if the space information has neither of the two, and as their
/// constructors do; both then keep the old checker.
void setChecker(const ompl::base::SpaceInformation& si, std::shared_ptr<const Checker> checker);

/// Sets start and goal of a setup from configurations of the checker's group; replaces earlier
/// ones. A value at most tolerance::kLimit beyond a bound of the space is moved to the bound, with
/// a warning to OMPL's console: the path begins and ends there. Throws std::invalid_argument if the
/// setup's space is not of that group, or a configuration does not have a value for each of the
/// group's variables; the setup then stays as it was.
void setStartAndGoal(ompl::geometric::SimpleSetup& setup, const Checker& checker,
                     ConfigurationView start, ConfigurationView goal);

}  // namespace swept
