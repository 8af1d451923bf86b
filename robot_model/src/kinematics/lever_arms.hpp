// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "kinematics/motion_model.hpp"

namespace swept::detail {

/// A ball rigidly attached to a body, with what bounds its points' motion.
///
/// arms[i] bounds the distance of every point of the ball from the rotation axis of joint path[i]
/// (from its centre, for a floating joint), over all configurations within the limits of prismatic
/// joints, not counting the translations of planar and floating joints.
struct LeverArms {
  std::vector<int> path;     ///< bodies from the model frame (exclusive) to the ball's, root first
  std::vector<double> arms;  ///< m
  /// m, bound on the distance of every point from the origin of path[0]'s joint frame.
  double reachFromBase = 0.0;
  /// m. What the ball's place is computed from is no larger: how far its points and the frames on
  /// the way to it can be from the model frame's origin, and those beyond each frame from that one.
  /// Rounding is as large as this, however near what comes of it. Translations of planar and
  /// floating joints come on top.
  double span = 0.0;
  double transforms = 0.0;  ///< multiplied on the way, see Fold
};

LeverArms leverArms(const KinematicModel& model, int body, const Eigen::Vector3d& center,
                    double radius);

/// Bounds over a whole motion, for every point of the ball, relative to an ancestor body (path
/// index `first` is the first joint that counts).
struct TravelBound {
  double speed = 0.0;         ///< m per unit t
  double acceleration = 0.0;  ///< m per unit t squared
};

TravelBound travelBound(const KinematicModel& model, const LeverArms& levers, std::size_t first,
                        std::span<const JointMotion> motion);

}  // namespace swept::detail
