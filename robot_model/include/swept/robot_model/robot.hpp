// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "swept/core/shapes.hpp"
#include "swept/core/sphere_cover.hpp"
#include "swept/robot_model/input.hpp"

namespace swept {

enum class JointType : std::uint8_t { Fixed, Revolute, Continuous, Prismatic, Planar, Floating };

/// Value of a mimicking joint = multiplier * value of `master` + offset.
struct Mimic {
  int master;  ///< index of a joint with variables of its own (chains are resolved)
  double multiplier;
  double offset;  ///< rad or m
};

/// A piece of a link's collision geometry.
struct CollisionGeometry {
  Shape shape;
  Eigen::Isometry3d link_from_shape;
  std::string source;  ///< mesh file, or the primitive's name
  /// Outer and inner balls, in the shape's frame; null for planes and half-spaces. Equal geometries
  /// of a robot share one.
  std::shared_ptr<const SphereCover> cover = nullptr;
  double coverSeconds = 0.0;  ///< s, to build the cover; 0 for all but the first that share one
};

struct Link {
  std::string name;
  int parentJoint = -1;  ///< -1 for the root link
  std::vector<CollisionGeometry> collision;
};

struct Joint {
  std::string name;
  JointType type = JointType::Fixed;
  int parentLink = -1;  ///< -1: the joint hangs on the model frame (SRDF virtual joint)
  int childLink = -1;
  Eigen::Isometry3d parent_from_joint = Eigen::Isometry3d::Identity();  ///< at value zero
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< unit, joint frame; planar: normal
  std::optional<Mimic> mimic;
  int firstVariable = -1;  ///< into Robot::variables(); -1 for fixed and mimicking joints
};

/// One number of a configuration. A planar joint has three (x, y in m; theta in rad), a floating
/// one seven (x, y, z in m; quaternion x, y, z, w), in this order.
struct Variable {
  std::string
      name;  ///< the joint's, or `joint/x`, `joint/theta`, `joint/trans_x`, `joint/rot_w`, ...
  int joint = -1;
  double lower = 0.0;   ///< rad or m; -infinity where nothing bounds it
  double upper = 0.0;   ///< rad or m
  bool cyclic = false;  ///< angle modulo 2 pi: interpolated the shorter way
};

struct Group {
  std::string name;
  std::vector<int> joints;     ///< those with variables, parents before children
  std::vector<int> variables;  ///< in the order of `joints`: the group's configuration
  int tipLink = -1;            ///< end of the chain, or the last link; -1 if none
};

struct NamedState {
  std::string name;
  std::string group;
  std::vector<std::pair<int, double>> values;  ///< (variable, value)
};

/// Two links that are not checked against each other.
struct DisabledPair {
  int linkA;
  int linkB;
  std::string reason;  ///< as the SRDF says it: Adjacent, Never, Default, ...
};

/// A kinematic tree with collision geometry, from URDF and SRDF. Immutable after loading. Covers
/// are built on as many threads as there are processors, and are the same on any number.
///
/// Links and joints are stored parents first. Mimicking joints follow their master and have no
/// variable. Lengths in metres, angles in radians.
class Robot {
 public:
  /// Reads a URDF and, when given, an SRDF. Throws InputError.
  static std::shared_ptr<const Robot> load(const std::filesystem::path& urdf,
                                           const std::filesystem::path& srdf = {},
                                           const LoadOptions& options = {});
  /// Same from text; `urdfName` is what messages call it, and relative meshes are looked up beside
  /// it.
  static std::shared_ptr<const Robot> parse(const std::string& urdfText,
                                            const std::string& urdfName,
                                            const std::string& srdfText = {},
                                            const std::string& srdfName = {},
                                            const LoadOptions& options = {});

  const std::string& name() const { return name_; }
  const std::vector<Link>& links() const { return links_; }
  const std::vector<Joint>& joints() const { return joints_; }
  const std::vector<Variable>& variables() const { return variables_; }
  /// The SRDF's groups; a robot without any has one, `all`, with every joint.
  const std::vector<Group>& groups() const { return groups_; }
  const std::vector<NamedState>& namedStates() const { return namedStates_; }
  const std::vector<DisabledPair>& disabledPairs() const { return disabledPairs_; }

  std::optional<int> findLink(std::string_view name) const;
  std::optional<int> findJoint(std::string_view name) const;
  std::optional<int> findVariable(std::string_view name) const;
  const Group* findGroup(std::string_view name) const;
  const NamedState* findNamedState(std::string_view name, std::string_view group) const;

  /// A configuration of all variables: zero where the limits allow it, else the middle of the
  /// limits; identity for floating joints.
  Eigen::VectorXd defaultState() const;

 private:
  friend class RobotBuilder;
  Robot() = default;
  std::string name_;
  std::vector<Link> links_;
  std::vector<Joint> joints_;
  std::vector<Variable> variables_;
  std::vector<Group> groups_;
  std::vector<NamedState> namedStates_;
  std::vector<DisabledPair> disabledPairs_;
};

}  // namespace swept
