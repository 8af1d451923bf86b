// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "swept/robot_model/cloud_file.hpp"
#include "swept/robot_model/world.hpp"

namespace swept {

/// The occupied cubes of a map as a body of the world: the smallest ones, of which there are most,
/// as a cloud of the balls that just contain them (each reaches 0.37 of the cube's side beyond its
/// faces), the others as boxes. A map that is empty gives a body without parts.
WorldBody occupiedBody(std::string name, const OccupancyMap& map,
                       const Eigen::Isometry3d& world_from_map);

}  // namespace swept
