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

/// A whole planning scene, as MoveIt's PlanningScene has it: the world, and what the file says of
/// the robot in it.
struct PlanningScene {
  World world;  ///< what stands around the robot, model frame
  /// rad or m: a value for each of the robot's variables. Those that the scene does not name have
  /// their value in Robot::defaultState(). Empty: the scene names none.
  std::optional<Eigen::VectorXd> state = {};
  std::vector<AttachedBody> attached = {};  ///< what links carry
  /// The scene has a collision matrix: it stands in place of all that a robot brings along, and no
  /// weaker rules than these should allow anything.
  bool hasMatrix = false;
  /// Where the scene's collision matrix differs from the SRDF and the robot's joints, and attached
  /// bodies that may touch each other.
  CollisionRules rules = {};

  /// Reads what World::load reads. Of planning-scene YAML also the robot's part:
  ///
  /// `robot_state` sets the state: joints by name, mimicking ones follow, planar and floating
  /// joints by pose. A value at most tolerance::kLimit beyond a limit is taken to it, with a
  /// warning. Objects stand in frames of the scene, of links, of attached bodies and of objects
  /// before them, at this state (at Robot::defaultState() where the scene has none).
  ///
  /// `attached_collision_objects` are attached. One without geometry takes the object of its id out
  /// of the world.
  ///
  /// An `allowed_collision_matrix` with entries stands in place of the SRDF's: what it does not
  /// allow is checked, links that a joint connects too.
  ///
  /// Throws InputError for what cannot be read, for joints, links and frames that nobody knows, for
  /// a collision matrix that is not square or symmetric, and for what would be left out: operations
  /// other than ADD, octomaps, padded and scaled links.
  static PlanningScene load(const std::filesystem::path& file, const Robot& robot,
                            const LoadOptions& options = {});

  /// What a Checker in `world` is made with: `own`, with this scene's state where it has no
  /// reference, this scene's attached bodies in front of its own, and this scene's rules, which
  /// count only where the own ones say nothing.
  CheckerOptions checkerOptions(CheckerOptions own = {}) const;
};

}  // namespace swept
