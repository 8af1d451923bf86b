// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "kinematics/lever_arms.hpp"
#include "kinematics/motion_model.hpp"
#include "swept/robot_model/task_constraint.hpp"

namespace swept::detail {

struct PairModel;

/// A point or a direction that one body carries, as an observer sees it from another. Only the
/// joints between the two and their last common ancestor move it: poses and bounds are relative to
/// this ancestor.
struct SeenVector {
  std::size_t link = 0;      ///< index into ConstraintModel::links
  std::size_t slot = 0;      ///< one for each of them
  bool fromTool = true;      ///< carried by the link's tool and seen from its reference, or reverse
  bool isDirection = false;  ///< else a point
  Eigen::Vector3d local = Eigen::Vector3d::Zero();  ///< m, or a unit vector: in the carrier's frame
  Eigen::Isometry3d observer_from_frame = Eigen::Isometry3d::Identity();
  LeverArms carrier;  ///< of the point
  /// Of the direction, per joint of the carrier's path: the largest sine of the angle between the
  /// two.
  std::vector<double> directionArms;
  LeverArms observer;      ///< of the frame's origin
  double magnitude = 0.0;  ///< m, of the numbers that place it
};

/// The moving bodies between a frame and the one that it is seen from.
struct ConstrainedLink {
  int tool = 0;       ///< into KinematicModel::bodies
  int reference = 0;  ///< likewise
  /// From the last common ancestor (exclusive) to each, root first; `first` joints of the paths
  /// from the model frame come before.
  std::vector<int> toolPath = {}, referencePath = {};
  std::size_t first = 0;
  double transforms = 0.0;  ///< multiplied on both ways, with those fixed in the bodies
};

/// Where a vector has to be: see the proofs in constraint_proof.cpp.
struct JointRange {
  int body = -1;           ///< into KinematicModel::bodies; -1: the group does not move the joint
  std::uint8_t value = 0;  ///< which of a planar or floating joint
  bool cyclic = false;
  double position = 0.0, above = 0.0, below = 0.0;  ///< rad or m
  double held = 0.0;                                ///< rad or m, of a joint that does not move
};
struct Regions {
  SeenVector point;  ///< in the reference frame
  std::vector<ConstraintRegion> regions;
};
struct EulerTolerances {
  SeenVector z;  ///< the tool's z axis in the frame of the desired orientation
  SeenVector x;  ///< the desired x axis in the tool's frame
  Eigen::Vector3d tolerance = Eigen::Vector3d::Zero();  ///< rad
  Eigen::Vector3d sine, cosine;                         ///< of these
};
struct RotationVectorTolerances {
  std::size_t link = 0;
  Eigen::Matrix3d tool_from_frame;
  Eigen::Matrix3d reference_from_frame;                 ///< the frame whose axes count
  Eigen::Matrix3d desired;                              ///< in that frame
  Eigen::Vector3d tolerance = Eigen::Vector3d::Zero();  ///< rad
};
struct Tilt {
  SeenVector axis;     ///< in a frame whose z is the direction
  double angle = 0.0;  ///< rad
  double sine = 0.0, cosine = 1.0;
};

struct CompiledConstraint {
  ConstraintViolation::Kind kind = ConstraintViolation::Kind::Joint;
  std::size_t index = 0;  ///< into the list of its kind
  std::variant<JointRange, Regions, EulerTolerances, RotationVectorTolerances, Tilt> what;
};

/// CheckerOptions::constraints for one group of a robot.
struct ConstraintModel {
  std::vector<ConstrainedLink> links;
  std::vector<CompiledConstraint> constraints;
  std::size_t vectors = 0;  ///< slots of SeenVector
  std::size_t bodies = 0;   ///< of KinematicModel::bodies: those from here on do not matter
  bool empty() const { return constraints.empty(); }
};

/// Most constraints of one checker.
inline constexpr std::size_t kMostConstraints = 64;

/// Reads the options, the kinematics, and the robot of the model. Throws std::invalid_argument as
/// Checker::withConstraints() does.
ConstraintModel compileConstraints(const PairModel& model);

}  // namespace swept::detail
