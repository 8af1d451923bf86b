// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/input_source.hpp"
#include "swept/core/shapes.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// Robots have tens, a scene in a URDF hundreds. What follows mimicking joints from one to the
/// next, and what looks at pairs of links, takes time with the square of it.
inline constexpr std::size_t kMaxJoints = 5000;

/// What the strict pass knows of a URDF and urdfdom does not keep: lines, the order of the file,
/// capsules.
struct UrdfOutline {
  struct Collision {
    int shapeLine = 0;
    bool withoutVolume = false;      ///< a primitive with a size of 0
    std::optional<Capsule> capsule;  ///< a common extension that urdfdom does not know
    std::string mesh;                ///< its file as the URDF has it; empty: a primitive
  };
  struct Link {
    std::string name;
    int line = 0;
    std::vector<Collision> collisions;
    bool hasVisual = false;
  };
  struct Mimic {
    std::string joint;
    int line = 0;
  };
  struct Joint {
    std::string name;
    int line = 0;
    JointType type = JointType::Fixed;
    std::string parent;
    std::string child;
    std::optional<Mimic> mimic;  ///< not for fixed joints
  };
  std::string robotName;
  std::vector<Link> links;
  std::vector<Joint> joints;
  /// The same robot with only what this project uses, every number checked: what urdfdom is given,
  /// so that an unreadable <visual> cannot stop a robot from loading.
  std::string reduced;
};

/// Checks every element that matters, one by one, then names, tree and mimics. Throws InputError.
UrdfOutline outlineUrdf(const std::string& text, const InputSource& source);

/// Names are unique and known, and the joints join the links to one tree.
void checkTree(const UrdfOutline& outline, const InputSource& source);

/// Every mimic names a joint that can be followed, and ends at one that follows no other.
void checkMimics(const UrdfOutline& outline, const InputSource& source);

}  // namespace swept::detail
