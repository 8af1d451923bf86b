// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "swept/robot_model/cloud_file.hpp"
#include "swept/robot_model/world.hpp"

namespace swept {

/// The occupied cubes of a map as a body of the world. The smallest cubes, which are most of them,
/// become a cloud of balls that just contain them (each reaches 0.37 of the cube's side beyond its
/// faces). The others become boxes. An empty map gives a body without parts.
WorldBody occupiedBody(std::string name, const OccupancyMap& map,
                       const Eigen::Isometry3d& world_from_map);

}  // namespace swept
