// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "swept/core/shapes.hpp"
#include "swept/robot_model/input.hpp"

namespace swept {

/// A named rigid obstacle: one or more shapes, fixed in the robot's model frame.
struct WorldBody {
  /// A shape with its pose.
  struct Part {
    Shape shape;                         ///< in its own frame
    Eigen::Isometry3d world_from_shape;  ///< pose in the model frame
  };
  std::string name;              ///< unique in its world
  std::vector<Part> parts = {};  ///< its geometry; none: it is not checked
};

/// A named rigid obstacle with a known motion.
struct MovingObstacle {
  /// A shape on the body.
  struct Part {
    Shape shape;                        ///< no plane and no half-space
    Eigen::Isometry3d body_from_shape;  ///< pose in the body's frame
  };
  /// The pose of the body at one time.
  struct Waypoint {
    double time;                        ///< s
    Eigen::Isometry3d world_from_body;  ///< pose in the model frame
  };
  std::string name;              ///< unique in its world
  std::vector<Part> parts = {};  ///< its geometry
  /// At least one, in order of time. Between two of them the body's origin moves straight and its
  /// orientation by slerp along the shorter arc, both at constant speed. Before the first and after
  /// the last it stands still.
  std::vector<Waypoint> waypoints = {};

  /// Pose world_from_body at a time (s).
  Eigen::Isometry3d poseAt(double time) const;
};

/// The obstacles around a robot, in its model frame (the URDF's root link, or the parent frame of
/// the SRDF's virtual joint). Copies share meshes, hulls and clouds.
class World {
 public:
  /// Reads planning-scene YAML (moveit_msgs layout, `.yaml`/`.yml`), MoveIt text (`.scene`) or a
  /// URDF (`.urdf`: its links in their default state are the bodies, the root link in the model
  /// frame). The extension gives the format. Throws InputError.
  ///
  /// It reads only the world and ignores the joint values of the scene's robot. Other data about
  /// the robot would add things to collide with, and is refused: attached objects, a moved base,
  /// objects placed in a frame of a link of the robot, a collision matrix. PlanningScene::load
  /// reads all of these.
  static World load(const std::filesystem::path& scene, const LoadOptions& options = {});

  /// Adds a body. Throws std::invalid_argument if the name is taken or a pose is not a finite rigid
  /// transform.
  void add(WorldBody body);
  /// Adds a body of one shape. Throws likewise.
  void add(std::string name, Shape shape, const Eigen::Isometry3d& world_from_shape);
  /// Adds a moving obstacle. Throws likewise, and for no waypoints, times that are not finite or do
  /// not increase, and unbounded shapes.
  void add(MovingObstacle obstacle);
  /// Replaces the body of this name, which has moved or changed its shape. Throws
  /// std::invalid_argument for a name that no static body has, and a pose that is not a finite
  /// rigid transform.
  void replace(WorldBody body);
  /// Replaces it by a body of one shape. Throws likewise.
  void replace(std::string name, Shape shape, const Eigen::Isometry3d& world_from_shape);
  /// Removes the body or the moving obstacle of this name. Returns false if nothing
  /// has it.
  bool remove(std::string_view name);

  ///@{
  /// In the order in which they were added.
  const std::vector<WorldBody>& bodies() const { return bodies_; }
  const std::vector<MovingObstacle>& obstacles() const { return obstacles_; }
  ///@}
  ///@{
  /// Null if none has this name; valid until the world changes.
  const WorldBody* find(std::string_view name) const;
  const MovingObstacle* findObstacle(std::string_view name) const;
  ///@}

 private:
  using Places = std::map<std::string, std::size_t, std::less<>>;
  void requireFree(const std::string& name) const;
  std::vector<WorldBody> bodies_;
  std::vector<MovingObstacle> obstacles_;
  Places placeOfBody_, placeOfObstacle_;  ///< by name, for scenes of many bodies
};

}  // namespace swept
