// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "io/yaml.hpp"
#include "swept/robot_model/world.hpp"

namespace swept::detail {

/// The `motion` of an object of a scene: poses of the object at times, in the frame that its header
/// names. None if the place is absent. Throws InputError for an empty list, an entry without time
/// or position, and times that do not increase.
std::vector<MovingObstacle::Waypoint> readMotion(const YamlPlace& motion);

}  // namespace swept::detail
