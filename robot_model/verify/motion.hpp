// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "model.hpp"

namespace swept::verify {

/// Pose and velocity of a link at one time: its point p has velocity linear + angular x p. All in
/// one reference frame, per unit of time.
struct Placed {
  Eigen::Isometry3d reference_from_link = Eigen::Isometry3d::Identity();
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();
};

/// Bounds for all points of a link within `reach` of its origin, over a whole motion. `extent` and
/// `turn` count the sizes of the terms of lengths and angles, not of the sums: offsets may cancel
/// most of them, and the rest rounds like the whole.
struct Bounds {
  double acceleration = 0.0;  ///< m per unit of time squared, relative to the reference frame
  double extent = 0.0;        ///< m, at least the distance from the origin of the reference frame
  double turn = 0.0;          ///< rad: largest angles and twice all that is turned, added up
  double spin = 0.0;          ///< rad: sum of all rotations
  int joints = 0;
};

/// The motion of a robot from one configuration to another, t from 0 to 1: angles and lengths
/// linear in t, cyclic angles the shorter way, floating orientations by slerp. A reference frame is
/// that of a link above, or -1 for the model's.
class Motion {
 public:
  Motion(const Model& model, std::span<const double> from, std::span<const double> to);

  Placed at(int link, int reference, double t) const;
  Bounds bounds(int link, int reference, double reach) const;

 private:
  /// child origin = translation + t rate; orientation = turn by (angle + t spin) about axis, after
  /// `rotation`. All in the joint frame.
  struct JointMotion {
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();         ///< m
    Eigen::Vector3d rate = Eigen::Vector3d::Zero();                ///< m
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< before the turn
    Eigen::Vector3d axis = Eigen::Vector3d::UnitX();               ///< unit
    double angle = 0.0;                                            ///< rad
    double spin = 0.0;                                             ///< rad
    double angles = 0.0;   ///< rad: what the angle is made of at either end, added up
    double lengths = 0.0;  ///< m: what the translation is made of at either end, added up
  };
  JointMotion jointMotion(const Joint& joint, std::span<const double> from,
                          std::span<const double> to) const;

  const Model& model_;
  std::vector<JointMotion> joints_;
};

/// Whether the group moves a link at all relative to a reference, a link above it or -1.
bool isMoved(const Model& model, int link, int reference);
/// The link nearest to both that is above, or is, each; -1: the model frame.
int commonAncestor(const Model& model, int a, int b);

}  // namespace swept::verify
