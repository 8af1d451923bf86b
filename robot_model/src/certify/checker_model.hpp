// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "kinematics/lever_arms.hpp"
#include "kinematics/motion_model.hpp"
#include "lanes/lane_model.hpp"
#include "lanes/lane_scratch.hpp"
#include "swept/core/separation.hpp"
#include "swept/core/sphere_cover.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept::detail {

/// A piece of collision geometry on a moving body.
struct RobotGeometry {
  int link = -1;
  int body = 0;
  Shape shape;
  Eigen::Isometry3d body_from_shape;
  Eigen::Vector3d center;  ///< m, of a ball that contains it, body frame
  double radius = 0.0;     ///< m
  LeverArms levers;
  std::shared_ptr<const SphereCover> cover;
};

/// A piece of the world, with the box that contains it.
struct WorldGeometry {
  int body = -1;  ///< index into World::bodies()
  Shape shape;
  Eigen::Isometry3d world_from_shape;
  Eigen::Isometry3d box_from_world;  ///< frame centred in the box, along its axes
  Eigen::Vector3d halfExtents;       ///< m
  double magnitude = 0.0;            ///< m, no point is farther from the model frame's origin
};

/// Geometry `a` of the robot against geometry `b` of the world or of the robot.
struct GeometryPair {
  int a = 0;
  int b = 0;
  bool self = false;
  int reference =
      0;  ///< body whose frame the relative motion is bounded in: the last common ancestor
  int travelA = 0;        ///< index into CheckerModel::travels
  int travelB = -1;       ///< likewise; -1 when b does not move relative to the reference
  double rounding = 0.0;  ///< m, bound on the error of the computed relative pose, for any point
};

/// A ball whose motion relative to an ancestor is bounded once per motion.
struct TravelSlot {
  int geometry = 0;
  std::size_t firstJoint = 0;  ///< index into the geometry's path
};

/// Robot x group x world, compiled: only what can move, only the pairs that can meet.
struct CheckerModel {
  std::shared_ptr<const Robot> robot;
  std::shared_ptr<const World> world;
  Group group;
  CheckerOptions options;
  KinematicModel kinematics;
  std::vector<RobotGeometry> robotGeometry;
  std::vector<WorldGeometry> worldGeometry;
  std::vector<TravelSlot> travels;
  std::vector<GeometryPair> pairs;
  LaneModel lanes;
  std::vector<Checker::Pair> checkedPairs;
  std::vector<Checker::Pair> skippedPairs;
  std::vector<Checker::Pair> standingContacts;

  std::string nameOfA(const GeometryPair& pair) const;
  std::string nameOfB(const GeometryPair& pair) const;
};

/// `like`: null, or the model of a checker that differs in nothing but its world.
std::shared_ptr<const CheckerModel> compileChecker(std::shared_ptr<const Robot> robot,
                                                   const Group& group,
                                                   std::shared_ptr<const World> world,
                                                   const CheckerOptions& options,
                                                   const CheckerModel* like = nullptr);

/// A part of a motion with the pairs not yet proven apart on it (a range of an arena of pair
/// indices).
struct PendingInterval {
  double begin = 0.0;
  double end = 1.0;
  std::size_t first = 0;
  std::size_t count = 0;
};

/// One pair of it.
struct PendingPart {
  std::uint32_t pair = 0;
  double begin = 0.0;
  double end = 1.0;
};

struct WorkspaceData {
  explicit WorkspaceData(const CheckerModel& model);

  std::vector<JointMotion> motion;
  /// At the current t; computed when first asked for.
  std::vector<BodyState> states;
  std::vector<std::int64_t> stateStamps;
  /// Per robot geometry at the current t; computed when first asked for.
  struct Placed {
    std::int64_t stamp = -1;
    Eigen::Vector3d center;  ///< m, model frame
    Eigen::Isometry3d world_from_shape;
    bool posed = false;
  };
  std::vector<Placed> placed;
  std::int64_t stamp = 0;
  /// Of the current motion; computed when first asked for.
  std::vector<TravelBound> travels;
  std::vector<std::int64_t> travelStamps;
  std::int64_t motionStamp = 0;
  double t = 0.0;
  double wander = 0.0;                 ///< m, of all planar and floating joints together
  std::vector<Eigen::Vector3d> hints;  ///< per pair, within one motion: last direction found
  std::vector<std::int64_t> hintStamps;
  std::vector<std::uint32_t> arena, nextArena, failed;
  std::vector<PendingInterval> generation, nextGeneration;
  LaneScratch lanes;
  /// What the lane tier left open, in order of time.
  std::vector<PendingInterval> pending;
  std::vector<std::uint32_t> pendingArena;
  std::vector<PendingPart> parts;
};

}  // namespace swept::detail
