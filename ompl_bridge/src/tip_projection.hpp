// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/ProjectionEvaluator.h>

#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// The space for the grids of planners of the KPIECE family: the position (m) of the group's tip
/// or, if the group moves no tip, its first two values. Cells have a fifteenth of the extents of 20
/// random states. Joints outside the group have their default values.
ompl::base::ProjectionEvaluatorPtr makeProjection(const ompl::base::StateSpace& space,
                                                  const Robot& robot, const Group& group);

}  // namespace swept::detail
