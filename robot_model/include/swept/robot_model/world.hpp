// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "swept/core/shapes.hpp"
#include "swept/robot_model/input.hpp"

namespace swept {

/// A named rigid obstacle: one or more shapes, fixed in the robot's model frame.
struct WorldBody {
  struct Part {
    Shape shape;
    Eigen::Isometry3d world_from_shape;
  };
  std::string name;
  std::vector<Part> parts = {};
};

/// A named rigid obstacle that moves in a known way.
struct MovingObstacle {
  struct Part {
    Shape shape;  ///< no plane and no half-space
    Eigen::Isometry3d body_from_shape;
  };
  struct Waypoint {
    double time;  ///< s
    Eigen::Isometry3d world_from_body;
  };
  std::string name;
  std::vector<Part> parts = {};
  /// At least one, in order of time. Between two of them the body's origin moves on a straight line
  /// and its orientation by slerp along the shorter arc, both evenly; before the first and after
  /// the last it stands still.
  std::vector<Waypoint> waypoints = {};

  /// world_from_body; s.
  Eigen::Isometry3d poseAt(double time) const;
};

/// The obstacles around a robot, in its model frame (the URDF's root link, or the parent frame of
/// the SRDF's virtual joint). Copies share meshes, hulls and clouds.
class World {
 public:
  /// Reads planning-scene YAML (moveit_msgs layout, `.yaml`/`.yml`), MoveIt text (`.scene`) or a
  /// URDF (`.urdf`: its links in their default state are the bodies, the root link in the model
  /// frame), told apart by the file's ending. Throws InputError.
  static World load(const std::filesystem::path& scene, const LoadOptions& options = {});

  /// Throws std::invalid_argument when the name is taken or a pose is not a rigid finite transform.
  void add(WorldBody body);
  void add(std::string name, Shape shape, const Eigen::Isometry3d& world_from_shape);
  /// Throws likewise, and for no waypoints, times that are not finite or do not increase, and
  /// shapes without bounds.
  void add(MovingObstacle obstacle);
  /// In the place of the body of this name, for what is elsewhere or has another shape by now.
  /// Throws std::invalid_argument for a name that no body which stands still has, and a pose that
  /// is not a rigid finite transform.
  void replace(WorldBody body);
  /// Either kind. False: nothing has this name.
  bool remove(std::string_view name);

  const std::vector<WorldBody>& bodies() const { return bodies_; }
  const std::vector<MovingObstacle>& obstacles() const { return obstacles_; }
  const WorldBody* find(std::string_view name) const;
  const MovingObstacle* findObstacle(std::string_view name) const;

 private:
  void requireFree(const std::string& name) const;
  std::vector<WorldBody> bodies_;
  std::vector<MovingObstacle> obstacles_;
};

}  // namespace swept
