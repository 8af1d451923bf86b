// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/sensed_world.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rounding/error_model.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

WorldBody occupiedBody(std::string name, const OccupancyMap& map,
                       const Eigen::Isometry3d& world_from_map) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return occupiedBody(std::move(name), map, world_from_map); });
  }
  WorldBody body{.name = std::move(name)};
  std::vector<Eigen::Vector3d> centers;
  double reach = 0.0;
  for (const OccupancyMap::Cube& cube : map.occupied) {
    if (cube.side > 1.5 * map.resolution) {
      const Eigen::Translation3d middle(cube.center);
      body.parts.push_back(
          {makeBox(Eigen::Vector3d::Constant(cube.side)), world_from_map * middle});
    } else {
      centers.push_back(cube.center);
      reach = std::max(reach, cube.center.lpNorm<Eigen::Infinity>());
    }
  }
  if (centers.empty()) return body;
  // Corners and centres of the cubes are rounded.
  const double radius =
      0.5 * std::sqrt(3.0) * map.resolution + detail::kPointShare * (reach + map.resolution);
  body.parts.push_back({PointCloud::build(centers, radius), world_from_map});
  return body;
}

}  // namespace swept
