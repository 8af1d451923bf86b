// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/ProjectionEvaluator.h>

#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// What planners of the KPIECE family keep their grids over: the position (m) of the group's tip
/// or, for a group without one that it moves, its first two values. Planners infer the size of the
/// cells. Joints outside the group stand at their default values.
ompl::base::ProjectionEvaluatorPtr makeProjection(const ompl::base::StateSpace& space,
                                                  const Robot& robot, const Group& group);

}  // namespace swept::detail
