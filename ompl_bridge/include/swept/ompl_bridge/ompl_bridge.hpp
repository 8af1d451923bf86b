// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// OMPL over a swept::Checker: `isValid` and `checkMotion` mean *proven free*. Holds no geometry.
#include "swept/ompl_bridge/certified_connect.hpp"
#include "swept/ompl_bridge/certified_roadmap.hpp"
#include "swept/ompl_bridge/clearance_objective.hpp"
#include "swept/ompl_bridge/constrained_space.hpp"
#include "swept/ompl_bridge/motion_validator.hpp"
#include "swept/ompl_bridge/nearest_states.hpp"
#include "swept/ompl_bridge/paths.hpp"
#include "swept/ompl_bridge/planners.hpp"
#include "swept/ompl_bridge/pose_goal.hpp"
#include "swept/ompl_bridge/schedule_plan.hpp"
#include "swept/ompl_bridge/setup.hpp"
#include "swept/ompl_bridge/state_space.hpp"
#include "swept/ompl_bridge/trajectory.hpp"
#include "swept/ompl_bridge/validity_checker.hpp"
