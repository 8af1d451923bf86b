// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <span>
#include <vector>

#include "robot/cyclic_values.hpp"
#include "robot/joint_types.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// Joints that stand still, multiplied into one frame.
struct FixedJointChain {
  /// Their number. A joint fixed at a large angle rounds like several joints.
  double transforms = 0.0;
  double farthest = 0.0;  ///< m, largest size of the frames between, and of their terms

  /// m. How far these frames go beyond the last one.
  double detour(const Eigen::Isometry3d& frame) const {
    return std::max(0.0, farthest - frame.translation().norm());
  }
};

/// A frame that the group moves, with everything rigidly attached to it.
struct MovingBody {
  int parent = -1;  ///< index into KinematicModel::bodies; 0 is the model frame
  int joint = -1;   ///< index into Robot::joints(); -1: none of the robot's
  JointType type = JointType::Fixed;
  Eigen::Isometry3d parent_from_joint = Eigen::Isometry3d::Identity();  ///< fixed joints folded in
  FixedJointChain fixedChain;                                           ///< of these
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();                      ///< unit, joint frame
  Eigen::Matrix3d planarBasis =
      Eigen::Matrix3d::Identity();  ///< columns x, y of a planar joint, normal
  int variable = -1;                ///< first index into the group's configuration
  double multiplier = 1.0;          ///< joint value = multiplier * variable + offset
  double offset = 0.0;              ///< rad or m
  double lower = 0.0;  ///< m or rad: range of the joint value, with the slack of limits
  double upper = 0.0;  ///< m or rad
  /// m, prismatic: how far the true value may be outside the range if a computed value is within
  /// it. An offset may cancel most of the terms that round.
  double valueRounding = 0.0;
};

/// The group's tree of moving frames. Joints outside the group are folded at their reference
/// values, so that parts that do not move cost nothing. After the bodies of the robot come those
/// attached to it, on joints that never move, and moving obstacles, each on its own floating joint.
///
/// A configuration is that of the group, followed by the time if there are moving obstacles. The
/// functions on motions read full configurations: these also have the poses of the obstacles, and
/// the size (m) of the coordinates that each was computed from.
struct KinematicModel {
  std::vector<MovingBody> bodies;  ///< parents first; [0] is the model frame itself
  std::vector<int> bodyOfLink;
  std::vector<Eigen::Isometry3d> body_from_link;
  std::vector<FixedJointChain> fixedChainOfLink;  ///< of the joints folded into these frames
  std::vector<char> cyclic;                       ///< per value of a configuration
  std::vector<double> lower, upper;               ///< likewise: rad, m or s
  int dimension = 0;                              ///< of a configuration
  int fullDimension = 0;                          ///< of a full configuration
  int firstObstacle = 0;  ///< index of the first body that is a moving obstacle
};

/// `reference` has a value for every variable of the robot.
KinematicModel compileKinematics(const Robot& robot, const Group& group,
                                 const Eigen::VectorXd& reference);

/// Adds a frame that is fixed in a moving body; returns its index.
int addAttachedFrame(KinematicModel& model, int body, const Eigen::Isometry3d& body_from_frame);
/// Adds frames for this many obstacles; returns the index of the first one.
int addObstacleFrames(KinematicModel& model, std::size_t count);

/// The motion of one joint during an interval of t: at `anchor + s` its child frame is [ exp(s
/// spin) rotation | translation + s rate ], all in the joint frame, up to the bounds on
/// accelerations. If both accelerations are 0, its rates are constant.
struct JointMotion {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();         ///< m, at the anchor
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();                ///< m per unit t, likewise
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< likewise
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();                ///< rad per unit t, likewise
  double anchor = 0.0;                                           ///< t
  double angle = 0.0;      ///< rad, at the anchor: a revolute joint's value, about its axis
  double angleRate = 0.0;  ///< rad per unit t, likewise
  ///@{
  /// Bounds over the interval.
  double speed = 0.0;             ///< m per unit t, no less than |rate|
  double spinSpeed = 0.0;         ///< rad per unit t, no less than |spin|
  double acceleration = 0.0;      ///< m per unit t squared, bounds that of the translation
  double spinAcceleration = 0.0;  ///< rad per unit t squared, likewise of the turn
  double maxTranslation = 0.0;    ///< m, planar and floating: largest |translation|
  double low = 0.0;               ///< m, prismatic: range of its value
  double high = 0.0;              ///< m
  double lowAngle = 0.0;          ///< rad, revolute: range of its value
  double highAngle = 0.0;         ///< rad
  double largestAngle = 0.0;      ///< rad, size of the terms of the joint's angle, for its rounding
  double slideError = 0.0;        ///< m, rounding of a translation beyond what its size gives
  ///@}

  /// m. Largest |translation| over the interval, for any type.
  double slid() const { return std::max({maxTranslation, -low, high}); }
  bool hasConstantRates() const { return acceleration == 0.0 && spinAcceleration == 0.0; }
};

/// The rounding that the joints carrying a body add to its position in one motion, beyond that with
/// all translations at zero. It is proportional to the values that the motion uses.
struct CarriedRounding {
  double slid = 0.0;        ///< m, all translations together
  double angleError = 0.0;  ///< rad, of angles larger than a few turns, and the shorter ways
  /// m. From translations that are small sums of much larger terms: a mimic joint's whose offset
  /// cancels most of its master's value, or an obstacle's between waypoints far away.
  double slideError = 0.0;
};

/// For a body that `joint` moves, whose parent has `before`.
CarriedRounding carriedRounding(const CarriedRounding& before, const JointMotion& joint);

/// Frame and velocity field of a body at one t: the point p (m, model frame) has velocity
/// linear + angular x p per unit t.
struct BodyState {
  Eigen::Isometry3d world_from_body = Eigen::Isometry3d::Identity();
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();
};

/// The norm of x, y, z, w. False, too, if the squares overflow, or a component is not finite.
bool hasDirection(const double* quaternion);

/// One joint's share of a motion whose values are finite. False as below.
bool compileJoint(const KinematicModel& model, const MovingBody& body, std::span<const double> from,
                  std::span<const double> to, JointMotion& motion);

/// False if a value is not finite, a quaternion is zero, or a prismatic value is outside its limits
/// (pairs that were left out as out of reach may be within it there).
bool compileMotion(const KinematicModel& model, std::span<const double> from,
                   std::span<const double> to, std::span<JointMotion> motion);

/// Frame and velocity of a body at t, from its parent's.
BodyState bodyAt(const MovingBody& body, const JointMotion& joint, double t,
                 const BodyState& parent);
/// The same, of a model's body.
void evaluateBody(const KinematicModel& model, std::span<const JointMotion> motion, double t,
                  int body, std::span<BodyState> states);

/// Configuration at t on the motion between configurations, or between full ones, whose rest is
/// ignored.
void interpolateMotion(const KinematicModel& model, std::span<const double> from,
                       std::span<const double> to, double t, std::span<double> q);
/// The orientations of floating joints alone, by slerp.
void interpolateOrientations(const KinematicModel& model, std::span<const double> from,
                             std::span<const double> to, double t, std::span<double> q);

}  // namespace swept::detail
