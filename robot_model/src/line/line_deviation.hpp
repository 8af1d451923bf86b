// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "kinematics/lever_arms.hpp"
#include "kinematics/motion_model.hpp"

namespace swept::detail {

/// A frame that is fixed in a moving body, with what bounds its motion.
struct CarriedTool {
  int body = 0;  ///< into KinematicModel::bodies
  Eigen::Isometry3d body_from_tool = Eigen::Isometry3d::Identity();
  LeverArms levers;         ///< of its origin
  double transforms = 0.0;  ///< multiplied into its pose
  double magnitude = 0.0;   ///< m, of the numbers that place it
};

/// `link_from_tool`: a rigid transform, orthonormal up to rounding.
CarriedTool carriedTool(const KinematicModel& model, std::size_t link,
                        const Eigen::Isometry3d& link_from_tool);

/// A piece of a straight motion of a tool, in the model frame: its origin goes along a segment, its
/// orientation turns about a fixed axis, both in proportion to u in [0, 1].
struct LinePiece {
  Eigen::Vector3d begin = Eigen::Vector3d::Zero(), end = Eigen::Vector3d::Zero();  ///< m
  Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();  ///< of the tool's frame at u = 0
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< rad, the rotation to that at u = 1

  Eigen::Matrix3d orientationAt(double u) const;
};

/// How far a tool is off a piece: the distance of its origin from the segment, and the angle
/// between its orientation and the piece's at the same u.
struct Deviation {
  double position = 0.0;  ///< m
  double angle = 0.0;     ///< rad; 0 if nobody asks

  /// The larger of both as shares of the allowed ones.
  double shareOf(const Deviation& allowed) const;
};

/// What is known of a straight motion between configurations beside a piece, u being its t.
struct DeviationProof {
  bool holds = false;
  Deviation most;     ///< proven for every u, if it holds
  Deviation middle;   ///< at u = 1/2, up to rounding: where it is about the largest
  int intervals = 0;  ///< examined
};

/// Room for one thread.
struct DeviationScratch {
  std::vector<JointMotion> motion;
  std::vector<double> arms;
  struct Interval {
    double begin, end;
  };
  std::vector<Interval> stack;
};

/// Proves that the tool is off the piece by no more than `allowed` (an angle of pi and more: any)
/// at every instant. Lemma and bounds are in line_deviation.cpp.
DeviationProof proveDeviation(const KinematicModel& model, const CarriedTool& tool,
                              const LinePiece& piece, std::span<const double> from,
                              std::span<const double> to, const Deviation& allowed,
                              DeviationScratch& scratch);

}  // namespace swept::detail
