// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "swept/core/distance.hpp"
#include "swept/robot_model/cloud_file.hpp"
#include "swept/robot_model/world.hpp"

/// A simulated depth camera, and the voxel map of what it sees.
struct DepthSensor {
  Eigen::Isometry3d world_from_sensor;  ///< looks along z
  int columns = 128, rows = 96;
  double halfWidth = 0.4;  ///< tangent of half the angle between the outermost columns
  double range = 3.0;      ///< m
  double noise = 0.002;    ///< m, standard deviation along the ray

  /// m, from a point to the nearest body; up to `enough`.
  static double nearest(const swept::World& world, const Eigen::Vector3d& point, double enough) {
    const swept::Shape dot = swept::makeSphere(1e-6);
    for (const swept::WorldBody& body : world.bodies())
      for (const swept::WorldBody::Part& part : body.parts)
        enough = std::min(
            enough, distance(dot, part.shape, Eigen::Translation3d(-point) * part.world_from_shape,
                             {.enough = enough})
                        .lower);
    return enough;
  }

  /// Where rays first meet a body (m, model frame), off by the noise. Each ray is followed in steps
  /// as long as the distance to the nearest body: it cannot pass through one (J. Hart, Sphere
  /// Tracing, 1996).
  std::vector<Eigen::Vector3d> points(const swept::World& world, std::mt19937& random) const {
    std::normal_distribution<double> error(0.0, noise);
    std::vector<Eigen::Vector3d> seen;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const double x = halfWidth * (2.0 * column / (columns - 1) - 1.0);
        const double y = halfWidth * rows / columns * (2.0 * row / (rows - 1) - 1.0);
        const Eigen::Vector3d ray =
            world_from_sensor.linear() * Eigen::Vector3d(x, y, 1.0).normalized();
        double along = 0.0, free = 1.0;
        for (int step = 0; step < 60 && along < range && free > 1e-3; ++step) {
          free = nearest(world, world_from_sensor.translation() + along * ray, range);
          along += free;
        }
        if (free <= 1e-3)
          seen.emplace_back(world_from_sensor.translation() + (along + error(random)) * ray);
      }
    return seen;
  }
};

/// The cubes of a grid that have a point in them.
inline swept::OccupancyMap voxels(const std::vector<Eigen::Vector3d>& points, double side) {
  std::set<std::tuple<double, double, double>> cells;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d cell = (point / side).array().floor();
    cells.emplace(cell.x(), cell.y(), cell.z());
  }
  swept::OccupancyMap map{.resolution = side, .occupied = {}};
  for (const auto& [x, y, z] : cells)
    map.occupied.push_back({side * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5), side});
  return map;
}
