// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "kinematics/lever_arms.hpp"
#include "kinematics/motion_model.hpp"
#include "model/shared_array.hpp"
#include "swept/core/separation.hpp"
#include "swept/core/sphere_cover.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept::detail {

/// m. Far below where squares overflow: an infinite distance would wrongly prove bodies apart.
/// Nothing is proven for coordinates that may be larger.
inline constexpr double kLargestNorm = 1e150;

/// The data of pairs, except for static bodies of the world.
struct CollisionBody {
  enum class Kind : std::uint8_t { Link, Attached, Obstacle };
  Kind kind = Kind::Link;
  BodyName name;
  int link = -1;  ///< into Robot::links(): itself, or the one it is attached to; -1: an obstacle
  int body = 0;   ///< into KinematicModel::bodies
  Eigen::Isometry3d body_from_frame = Eigen::Isometry3d::Identity();
};

/// A piece of collision geometry of a collision body.
struct RobotGeometry {
  int collisionBody = -1;
  int piece = 0;       ///< of the collision body
  double scale = 1.0;  ///< factor that scaled the shape
  int body = 0;        ///< the collision body's
  Shape shape;
  Eigen::Isometry3d body_from_shape;
  Eigen::Vector3d center;  ///< m, of a ball that contains it, body frame
  double radius = 0.0;     ///< m
  /// m, of its coordinates in the shape's frame and of what places that in the body's.
  double magnitude = 0.0;
  double transforms = 0.0;   ///< multiplied to place it in the model frame
  double sourceError = 0.0;  ///< m, sourceErrorOf() the shape
  LeverArms levers;
  std::shared_ptr<const SphereCover> cover;
};

/// A piece of the world, with the box that contains it.
struct WorldGeometry {
  int body = -1;       ///< index into World::bodies()
  int part = 0;        ///< of the body
  double scale = 1.0;  ///< factor that scaled the shape
  Shape shape;
  Eigen::Isometry3d world_from_shape;
  Eigen::Isometry3d box_from_world;  ///< frame centred in the box, along its axes
  Eigen::Vector3d halfExtents;       ///< m
  /// m, of its coordinates in the shape's frame and of what places that: no point is farther from
  /// the model frame's origin.
  double magnitude = 0.0;
  double sourceError = 0.0;  ///< m, sourceErrorOf() the shape
};

/// Geometry `a` of the robot against geometry `b` of the world or of the robot.
struct GeometryPair {
  int a = 0;
  int b = 0;
  bool self = false;
  int reference =
      0;  ///< body whose frame the relative motion is bounded in: the last common ancestor
  int motionBoundA = 0;   ///< index into PairModel::motionBounds
  int motionBoundB = -1;  ///< likewise; -1 when b does not move relative to the reference
  /// m, bound on the error of the computed relative pose, for any point, while all translations are
  /// zero and angles small; see CarriedRounding for the rest. With `sourceError`.
  double rounding = 0.0;
  double margin = 0.0;       ///< m, what the two have to keep
  double sourceError = 0.0;  ///< m, of both geometries
  /// m. How much nearer than in a configuration the two can be in one that PairModel::tube allows
  /// beside it; infinity: no bound is known.
  double tube = 0.0;

  /// m. What geometry as it is has to keep, so that the two keep their margin wherever the errors
  /// of their sources have them.
  double kept() const { return margin + sourceError; }
};

/// A checked pair with the world. The rest of its GeometryPair follows: see PairModel::pair.
struct WorldPair {
  int a = 0;  ///< index into PairModel::robotGeometry
  int b = 0;  ///< index into PairModel::worldGeometry
};

/// Whether a pair of bodies is checked, or why not.
enum class PairReason : std::uint8_t {
  Checked,
  Allowed,     ///< by a rule
  Disabled,    ///< by the SRDF, a joint between the two, or as touch links
  Unmoved,     ///< a link that the group does not move, and the world
  Rigid,       ///< the group does not change their relative pose
  OutOfReach,  ///< of the link, whatever the group does
};

/// A collision body and a body of the world, or two collision bodies.
struct BodyPair {
  int a = 0;              ///< index into PairModel::collisionBodies
  int b = 0;              ///< index into World::bodies(), or of the second collision body
  bool ofRobot = false;   ///< two collision bodies
  bool touching = false;  ///< of those that do not move: in contact
  /// For checked links: proven apart within the limits of the joints, so they are tested only
  /// outside of these.
  bool never = false;
  PairReason reason = PairReason::Checked;
  double margin = 0.0;  ///< m
};

/// m, per pair of links (the smaller index first): the distance that they are proven to keep.
using NeverMargins = std::map<std::pair<int, int>, double>;

/// For people to read; computed on the first request.
struct PairLists {
  std::once_flag made;
  std::vector<Checker::Pair> checked, skipped, standing;
};

/// A ball whose motion relative to an ancestor is bounded once per motion.
struct MotionBoundSlot {
  int geometry = 0;
  std::size_t firstJoint = 0;  ///< index into the geometry's path
};

/// Robot x group x world, compiled: only moving parts, only pairs that can meet. It is in double
/// precision; the single-precision tier compiles its own model from it (SimdModel).
struct PairModel {
  std::uint64_t version = 0;  ///< no two have the same
  std::shared_ptr<const Robot> robot;
  std::shared_ptr<const World> world;
  Group group;
  CheckerOptions options;
  KinematicModel kinematics;
  /// Per moving body: how far its joint may be off its value. Empty: not at all.
  std::vector<JointTolerance> tube;
  std::vector<CollisionBody>
      collisionBodies;  ///< links, as in Robot::links(), attached bodies, obstacles
  SharedArray<RobotGeometry> robotGeometry;
  std::vector<WorldGeometry> worldGeometry;
  std::vector<MotionBoundSlot> motionBounds;
  ///@{
  /// The checked pairs. A pair's index counts those with the world first: a map of many boxes has a
  /// million, too many to write down more than which they are.
  std::vector<WorldPair> worldPairs;  ///< by robot geometry, ascending
  std::vector<GeometryPair> pairs;    ///< all others
  std::size_t pairCount() const { return worldPairs.size() + pairs.size(); }
  GeometryPair pair(std::size_t index) const;
  ///@}
  /// Per robot geometry, and one more: of its pairs with the world, the first.
  std::vector<std::uint32_t> firstWorldPair;
  std::uint32_t firstSelfPair = 0;
  ///@{
  /// Distances are measured between all pieces of the bodies that are checked against each other.
  /// Pieces out of reach of each other are in none of the pairs, and are not listed anywhere, since
  /// there may be many.
  /// Per collision body: its pair with the world's first body, into bodyPairs; -1: it is checked
  /// against none.
  std::vector<int> firstBodyPair;
  /// Per robot geometry of the other collision bodies: the common part of its pairs with the world,
  /// with the largest rounding among them.
  std::vector<GeometryPair> likeWorldPairs;
  std::vector<double> worldTubes;  ///< m, per robot geometry: GeometryPair::tube; empty: no tube
  std::int64_t measuredPairs =
      0;  ///< how many pairs of pieces that is, two collision bodies' among them
  ///@}
  double largestMargin = 0.0;                        ///< m, of the pairs
  double largestRounding = 0.0;                      ///< m, likewise
  double largestSpan = 0.0;                          ///< m, likewise, see spanOf
  double largestTransforms = 0.0;                    ///< likewise, see transformsOf
  std::vector<BodyPair> bodyPairs;                   ///< of the world first
  std::shared_ptr<const NeverMargins> neverMargins;  ///< what the first version has proven
  std::shared_ptr<PairLists> lists = std::make_shared<PairLists>();

  BodyName nameOfA(const GeometryPair& pair) const;
  BodyName nameOfB(const GeometryPair& pair) const;
  bool isSelfPair(
      const GeometryPair& pair) const;  ///< as Witness has it: moving obstacles are none
  /// Whether the pair of bodies of these two pieces is checked.
  bool checksWorld(int ofRobot, int ofWorld) const;
};

/// m. Upper bound on the distance of the pair's robot geometry from a joint that carries it, for
/// both together, without translations.
inline double spanOf(const PairModel& model, const GeometryPair& pair) {
  const double span = model.robotGeometry[pair.a].levers.spanAtRest;
  return pair.self ? span + model.robotGeometry[pair.b].levers.spanAtRest : span;
}
/// Multiplied to place both.
inline double transformsOf(const PairModel& model, const GeometryPair& pair) {
  const double transforms = model.robotGeometry[pair.a].transforms;
  return pair.self ? transforms + model.robotGeometry[pair.b].transforms : transforms;
}

/// Frames and geometry. `model` has the robot, the world, the group and the options. `like`: null,
/// or an earlier version for the same robot, group and reference, from which unchanged parts are
/// taken. Throws std::invalid_argument for attached bodies and rules as the constructor of Checker
/// does.
void compileGeometry(const PairModel* like, PairModel& model);
/// The pairs of that geometry; the geometry may be read meanwhile.
void compilePairsOf(const PairModel* like, PairModel& model);

}  // namespace swept::detail
