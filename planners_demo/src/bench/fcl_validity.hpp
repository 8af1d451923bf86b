// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>

#include "swept/robot_model/checker.hpp"

namespace swept {

/// Valid: FCL finds none of the checker's pairs in collision. For one thread. `checker` has to
/// outlive the result. Throws UsageError as measureFcl does.
ompl::base::StateValidityCheckerPtr fclValidity(const ompl::base::SpaceInformationPtr& si,
                                                const Checker& checker);

}  // namespace swept
