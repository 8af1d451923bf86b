// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/SpaceInformation.h>

#include <memory>

#include "swept/robot_model/checker.hpp"

namespace swept::detail {

/// The checker of this bridge's validators. Null: those in use are of others.
std::shared_ptr<const Checker> checkerOf(const ompl::base::SpaceInformation& si);

}  // namespace swept::detail
