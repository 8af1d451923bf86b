// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/geometric/SimpleSetup.h>

#include <cstdint>
#include <memory>

#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// How motions are checked.
enum class MotionCheck : std::uint8_t {
  Certified,  ///< CertifiedMotionValidator: valid means proven free
  /// OMPL's DiscreteMotionValidator over the same ValidityChecker: at the space's resolution, for
  /// comparison. What it calls valid may collide between its samples.
  Discrete,
};

struct SetupOptions {
  StateSpaceOptions space = {};
  MotionCheck motions = MotionCheck::Certified;
};

/// One call: space, checker and validator of a group, ready for start, goal and planner.
/// Throws std::invalid_argument without a checker, and as makeStateSpace and ValidityChecker do.
ompl::geometric::SimpleSetupPtr makeSimpleSetup(std::shared_ptr<const Checker> checker,
                                                const SetupOptions& options = {});

}  // namespace swept
