// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <variant>
#include <vector>

#include "kinematics/degrees_of_freedom.hpp"
#include "kinematics/motion_model.hpp"
#include "swept/robot_model/checker.hpp"

/// Constraints as numbers for searches. Those for proofs are in constraint_model.hpp.
namespace swept::detail {

/// A tolerance counts as no less (rad or m): shares of it are numbers.
inline constexpr double kLeastLimit = 1e-9;

/// A value that a constraint limits. `count` rows from this one on are a vector whose length is
/// limited; 0: of the vector before.
struct ConstraintRow {
  double value = 0.0;      ///< rad or m
  double tolerance = 1.0;  ///< rad or m
  double unit = 1.0;       ///< rad or m that counts as much as a radian
  int count = 1;
};

/// Two frames, and the joints between them and their last common ancestor.
struct FramePair {
  int tool = 0, reference = 0;  ///< into KinematicModel::bodies
  Eigen::Isometry3d tool_from_frame = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d reference_from_frame = Eigen::Isometry3d::Identity();
  std::vector<int> toolPath = {}, referencePath = {};  ///< bodies, root first
};

struct JointPart {
  int degree = -1;  ///< -1: the group does not move it
  int variable = -1;
  double multiplier = 1.0, offset = 0.0;  ///< value = multiplier * variable + offset
  bool cyclic = false;
  double position = 0.0;  ///< rad or m
  double middle = 0.0;    ///< of what is allowed, relative to `position`
  double tolerance = 0.0;
  bool slides = false;
};
struct RegionsPart {
  FramePair frames;
  std::vector<ConstraintRegion> regions;
};
struct AnglesPart {
  FramePair frames;
  OrientationConstraint::Parameterization parameterization;
  Eigen::Matrix3d desired;
  std::vector<int> limited;  ///< which of the three
  Eigen::Vector3d tolerance;
};
struct TiltPart {
  FramePair frames;        ///< of the reference, z is the direction
  Eigen::Vector3d axis;    ///< unit, in the tool's frame
  double tolerance = 0.0;  ///< rad
};

struct ConstraintPart {
  std::variant<JointPart, RegionsPart, AnglesPart, TiltPart> what;
  int firstRow = 0, rows = 0;
};

struct ConstraintTask {
  KinematicModel kinematics;
  DegreesOfFreedom freedom;
  std::vector<std::string> variables;  ///< names, for messages
  std::vector<ConstraintPart> parts;
  std::vector<int> bodies;  ///< that matter, parents first
  int rows = 0;
  double scale = 1.0;  ///< m that count as much as a radian
};

/// The checker has refused constraints that make no sense.
ConstraintTask compileTask(const Checker& checker);

}  // namespace swept::detail
