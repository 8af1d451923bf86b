// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "swept/robot_model/checker.hpp"

namespace swept::test {

/// A ball (radius kBallRadius) on three prismatic joints along x, y, z in [-1, 1]: its clearance is
/// that of a point to the obstacles, which has a closed form.
std::shared_ptr<const Robot> gantry();
inline constexpr double kBallRadius = 0.1;  // m

/// Every joint type, in this order: prismatic `slide`, continuous `turn`, revolute `elbow` and
/// `wrist` with `follower` mimicking `elbow`, planar `cart`, floating `body` with a ball of 0.05 m.
std::shared_ptr<const Robot> everyJoint();

/// An axis-aligned box of the world, and the distance of a point from it.
struct Obstacle {
  Eigen::Vector3d centre;
  Eigen::Vector3d size;
  double distance(const Eigen::Vector3d& point) const;
};

/// Boxes the ball of the gantry moves between.
std::vector<Obstacle> boxes();
/// A wall across x = 0 with a square window of 0.4 m around (y, z) = (0.5, 0.5).
std::vector<Obstacle> wallWithWindow();
std::shared_ptr<const World> worldOf(const std::vector<Obstacle>& obstacles);

}  // namespace swept::test
