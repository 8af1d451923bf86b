// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/StateSpace.h>

#include "swept/ompl_bridge/pose_goal.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept::detail {

/// The bounds of a space of the checker's group, built as makeStateSpace does.
SpaceBounds boundsOf(const ompl::base::StateSpace& space, const Checker& checker);

}  // namespace swept::detail
