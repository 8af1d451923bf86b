// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

#include "swept/robot_model/attached_body.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/collision_rules.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/world.hpp"

namespace swept {

/// A whole planning scene, like MoveIt's PlanningScene: the world, and what the file says about the
/// robot.
struct PlanningScene {
  World world;  ///< obstacles around the robot, model frame
  /// rad or m: a value for each of the robot's variables. Those that the scene does not name have
  /// their value in Robot::defaultState(). No value: the scene names none.
  std::optional<Eigen::VectorXd> state = {};
  std::vector<AttachedBody> attached = {};  ///< bodies that links carry
  /// The scene has a collision matrix, which replaces the robot's own rules: no weaker rules than
  /// these should allow anything.
  bool hasMatrix = false;
  /// Rules where the scene's collision matrix differs from the SRDF and the robot's joints, and for
  /// attached bodies that may touch each other.
  CollisionRules rules = {};

  /// Reads the formats of World::load. From planning-scene YAML it also reads the robot's part:
  ///
  /// `robot_state` sets the state: joints by name, planar and floating joints by pose; mimicking
  /// joints follow. A value at most tolerance::kLimit beyond a limit is moved to it, with a
  /// warning. Objects may be in frames of the scene, of links, of attached bodies and of earlier
  /// objects, at this state (at Robot::defaultState() if the scene has none).
  ///
  /// `attached_collision_objects` are attached. One without geometry takes the object of its id out
  /// of the world.
  ///
  /// An `allowed_collision_matrix` with entries replaces the SRDF's: pairs that it does not allow
  /// are checked, even two links that a joint connects.
  ///
  /// Throws InputError for a file that cannot be read, for unknown joints, links and frames, for a
  /// collision matrix that is not square or symmetric, and for content that it cannot keep:
  /// operations other than ADD, octomaps, padded and scaled links.
  static PlanningScene load(const std::filesystem::path& file, const Robot& robot,
                            const LoadOptions& options = {});

  /// Options of a Checker in `world`: `own`, with this scene's state if it has no reference, with
  /// this scene's attached bodies before its own, and with this scene's rules below its own rules.
  CheckerOptions checkerOptions(CheckerOptions own = {}) const;
};

}  // namespace swept
