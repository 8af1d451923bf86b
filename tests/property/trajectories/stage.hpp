// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "../../core/split_mix.hpp"
#include "swept/robot_model/checker.hpp"

namespace trajectories {

/// The same numbers for the same seed and index.
class Random : public swept::test::SplitMix {
 public:
  Random(std::uint64_t seed, std::uint64_t index) : SplitMix(seed * 0x2545f4914f6cdd1du) {
    state_ = next() ^ (index * 0x9e3779b97f4a7c15u);
    next();
  }
};

/// A robot's group in a world.
struct Scene {
  std::string name;
  std::shared_ptr<const swept::Robot> robot;
  std::string group;
  std::shared_ptr<const swept::World> world;
};

/// Robots of models/ in its worlds. Between them every type of joint, a world with moving
/// obstacles, and a mimicking joint.
const std::vector<Scene>& scenes();

/// A joint of a group, its values and its tolerance.
struct StageJoint {
  swept::JointType type = swept::JointType::Fixed;
  std::size_t first = 0;  ///< of its values in a configuration
  swept::JointTolerance tolerance;
};

/// A variable's limits.
struct StageVariable {
  double lower = 0.0;  ///< rad or m
  double upper = 0.0;
  bool slides = false;       ///< it may not leave its limits
  bool cyclic = false;       ///< an angle without limits
  bool orientation = false;  ///< a component of a quaternion, without limits
};

/// A scene, a tube and a margin.
struct Stage {
  std::string scene;
  swept::Checker checker;  ///< under test
  swept::Checker plain;    ///< the judge: no tube
  std::vector<StageJoint> joints;
  std::vector<StageVariable> variables;
  double widest = 0.0;  ///< rad or m, of all tolerances
  bool timed = false;   ///< a configuration ends with the time

  std::size_t values() const { return variables.size(); }
};

/// Kinds of tubes that stages take turns with: none; narrow; up to 5e-3; wide (rad, m).
inline constexpr std::uint64_t kTubes = 4;

/// Scenes and kinds of tubes in turn.
Stage makeStage(std::uint64_t seed, std::uint64_t index);

}  // namespace trajectories
