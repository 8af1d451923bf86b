// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <limits>
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

/// The joint types of URDF. A planar joint has three values, a floating one seven. A continuous
/// joint is read as Revolute, from -pi to pi, if a mimicking joint does not repeat after a turn of
/// it: one that slides, or turns by a multiplier that is no whole number. Loading warns of it.
enum class JointType : std::uint8_t { Fixed, Revolute, Continuous, Prismatic, Planar, Floating };

/// Value of a mimicking joint = multiplier * value of `master` + offset.
struct Mimic {
  int master;         ///< index of a joint with variables of its own (chains are resolved)
  double multiplier;  ///< of the master's value
  double offset;      ///< rad or m
};

/// A piece of a link's collision geometry.
struct CollisionGeometry {
  Shape shape;                        ///< in its own frame
  Eigen::Isometry3d link_from_shape;  ///< pose of the shape in the link's frame
  std::string source;                 ///< mesh file, or the primitive's name
  /// Outer and inner balls, in the shape's frame; null for planes and half-spaces. Equal geometries
  /// of a robot share a cover.
  std::shared_ptr<const SphereCover> cover = nullptr;
  double coverSeconds = 0.0;  ///< s, to build the cover; 0 for all but the first that share it
};

/// A rigid body of the robot.
struct Link {
  std::string name;                          ///< unique
  int parentJoint = -1;                      ///< -1 for the root link
  std::vector<CollisionGeometry> collision;  ///< none: the link is not checked
  bool hasVisual = false;                    ///< the URDF has a `<visual>` for it
};

/// A joint between a link and its parent.
struct Joint {
  std::string name;                   ///< unique
  JointType type = JointType::Fixed;  ///< Fixed if nothing moves
  int parentLink = -1;                ///< -1: the parent is the model frame (SRDF virtual joint)
  int childLink = -1;                 ///< index of the link that it moves
  Eigen::Isometry3d parent_from_joint = Eigen::Isometry3d::Identity();  ///< at value zero
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< unit, joint frame; planar: normal
  std::optional<Mimic> mimic;                       ///< present: the joint has no variable
  int firstVariable = -1;  ///< into Robot::variables(); -1 for fixed and mimicking joints
  bool passive = false;    ///< the SRDF says that nothing drives it: it is in no group
};

/// One number of a configuration. A planar joint has three (x, y in m along the first two columns
/// of axisFrame(axis); theta in rad about the axis), a floating one seven (x, y, z in m; quaternion
/// x, y, z, w), in this order.
struct Variable {
  std::string
      name;  ///< the joint's, or `joint/x`, `joint/theta`, `joint/trans_x`, `joint/rot_w`, ...
  int joint = -1;       ///< index of its joint
  double lower = 0.0;   ///< rad or m, of `<limit>`; -infinity if unbounded
  double upper = 0.0;   ///< rad or m; infinity if unbounded
  bool cyclic = false;  ///< angle modulo 2 pi: interpolated the shorter way
  /// rad/s or m/s, of `<limit velocity>`, without its sign; infinity if that is missing or 0, and
  /// for planar and floating joints.
  double velocity = std::numeric_limits<double>::infinity();
};

/// Joints that are planned together.
struct Group {
  std::string name;            ///< from the SRDF, or `all`
  std::vector<int> joints;     ///< those with variables, parents before children
  std::vector<int> variables;  ///< in the order of `joints`: the group's configuration
  int tipLink = -1;            ///< end of the chain, or the last link; -1 if none
};

/// A named state of the SRDF.
struct NamedState {
  std::string name;                            ///< from the SRDF
  std::string group;                           ///< the group that it belongs to
  std::vector<std::pair<int, double>> values;  ///< (variable, value)
};

/// Two links that are not checked against each other.
struct DisabledPair {
  int linkA;           ///< index
  int linkB;           ///< index
  std::string reason;  ///< from the SRDF: Adjacent, Never, Default, ...
};

/// Two links that the SRDF enables (`<enable_collisions>`): they are checked although a joint
/// connects them, or another default leaves them out.
struct EnabledPair {
  int linkA;  ///< index
  int linkB;  ///< index
};

/// A group or a named state of the SRDF that was dropped.
struct LeftOut {
  std::string group;   ///< its name
  std::string state;   ///< empty: the group itself
  std::string reason;  ///< `file:line: what is wrong with it`
};

/// A kinematic tree with collision geometry, from URDF and SRDF. Immutable after loading. As many
/// threads as there are processors build the covers; these are the same for any number.
///
/// Links and joints are stored parents first. Mimicking joints follow their master and have no
/// variable. Lengths are in metres, angles in radians.
class Robot {
 public:
  /// Reads a URDF and, if given, an SRDF; for the one beside the URDF, see srdfBeside. Throws
  /// InputError.
  static std::shared_ptr<const Robot> load(const std::filesystem::path& urdf,
                                           const std::filesystem::path& srdf = {},
                                           const LoadOptions& options = {});
  /// The file beside the URDF with the same name and the extension `.srdf`, if there is one; else
  /// empty. `swept` reads it unless told otherwise.
  static std::filesystem::path srdfBeside(const std::filesystem::path& urdf);
  /// Like load, from text. Messages call the text `urdfName`, and relative meshes are searched
  /// beside it.
  static std::shared_ptr<const Robot> parse(const std::string& urdfText,
                                            const std::string& urdfName,
                                            const std::string& srdfText = {},
                                            const std::string& srdfName = {},
                                            const LoadOptions& options = {});

  /// The name in the URDF.
  const std::string& name() const { return name_; }
  /// The name in files of the frame that all poses are in: the parent frame of the SRDF's virtual
  /// joint; without one, the root link's name.
  const std::string& modelFrame() const { return modelFrame_; }
  ///@{
  /// Parents first; indices elsewhere refer to these.
  const std::vector<Link>& links() const { return links_; }
  const std::vector<Joint>& joints() const { return joints_; }
  const std::vector<Variable>& variables() const { return variables_; }
  ///@}
  /// The SRDF's groups; a robot without any has one, `all`, with every joint.
  const std::vector<Group>& groups() const { return groups_; }
  /// Named states of all groups.
  const std::vector<NamedState>& namedStates() const { return namedStates_; }
  /// Pairs that the SRDF disables; none without an SRDF. A link of `<disable_default_collisions>`
  /// is in a pair with each other link that is not enabled with it.
  const std::vector<DisabledPair>& disabledPairs() const { return disabledPairs_; }
  /// Pairs that the SRDF enables; none of them is disabled.
  const std::vector<EnabledPair>& enabledPairs() const { return enabledPairs_; }
  /// Groups and states that were dropped because they name something the URDF lacks.
  const std::vector<LeftOut>& leftOut() const { return leftOut_; }

  ///@{
  /// Index by name; no value if there is none.
  std::optional<int> findLink(std::string_view name) const;
  std::optional<int> findJoint(std::string_view name) const;
  std::optional<int> findVariable(std::string_view name) const;
  ///@}
  ///@{
  /// Null if there is none; lives as long as the robot.
  const Group* findGroup(std::string_view name) const;
  const NamedState* findNamedState(std::string_view name, std::string_view group) const;
  ///@}

  ///@{
  /// This robot with one more group: of the movable joints among these, or among those between two
  /// links (as a `<chain>` of an SRDF, without passive ones). Throws std::invalid_argument for a
  /// name that is taken, an unknown joint or link, and a joint without its own values.
  std::shared_ptr<const Robot> withGroup(const std::string& name,
                                         std::span<const std::string> joints) const;
  std::shared_ptr<const Robot> withChain(const std::string& name, const std::string& baseLink,
                                         const std::string& tipLink) const;
  ///@}

  /// Names of the links with a `<visual>` but no `<collision>`: every answer is about the robot
  /// without them. Links that have neither are pure frames and not included.
  std::vector<std::string> linksWithoutGeometry() const;

  /// A configuration of all variables: zero where the limits allow it, else the middle of the
  /// limits; identity for floating joints.
  Eigen::VectorXd defaultState() const;

 private:
  friend class RobotBuilder;
  Robot() = default;
  std::string name_;
  std::string modelFrame_;
  std::vector<Link> links_;
  std::vector<Joint> joints_;
  std::vector<Variable> variables_;
  std::vector<Group> groups_;
  std::vector<NamedState> namedStates_;
  std::vector<DisabledPair> disabledPairs_;
  std::vector<EnabledPair> enabledPairs_;
  std::vector<LeftOut> leftOut_;
};

}  // namespace swept
