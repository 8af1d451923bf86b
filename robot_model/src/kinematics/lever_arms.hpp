// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "kinematics/motion_model.hpp"

namespace swept::detail {

/// A ball rigidly attached to a body, with the data that bounds its points' motion.
///
/// arms[i] bounds the distance of every point of the ball from the rotation axis of joint path[i]
/// (from its centre, for a floating joint), over all configurations within the limits of prismatic
/// joints, without the translations of planar and floating joints. Bounds for one motion must not
/// depend on the limits, which may be far wider: see motionArms.
struct LeverArms {
  std::vector<int> path;     ///< bodies from the model frame (exclusive) to the ball's, root first
  std::vector<double> arms;  ///< m
  /// Whether a prismatic joint is behind one that turns: the lever arms then depend on the motion.
  bool vary = false;
  /// m, bound on the distance of every point from the origin of path[0]'s joint frame.
  double reachFromBase = 0.0;
  /// m. Upper bound on the terms of the ball's position: the distance of its points and of the
  /// frames on the way from the model frame's origin, and of those beyond each frame from that
  /// frame. Translations of planar and floating joints are added to it.
  double span = 0.0;
  /// m. The same with prismatic joints at zero: all translations are added to it. Rounding is
  /// proportional to this plus the translations that the motion uses, however small their sum is.
  double spanAtRest = 0.0;
  double transforms = 0.0;  ///< number multiplied on the way, see FixedJointChain
};

LeverArms leverArms(const KinematicModel& model, int body, const Eigen::Vector3d& center,
                    double radius);

/// Lever arms of the same ball over one motion, written to `arms`, one per joint of the path.
void motionArms(const KinematicModel& model, int body, const Eigen::Vector3d& center, double radius,
                std::span<const JointMotion> motion, std::span<double> arms);

/// Paths with more joints take time and memory proportional to their length, not to its square.
inline constexpr std::size_t kLongPath = 128;

/// m, per joint of the path: lever arms with all prismatic joints at zero. The joints beyond
/// lengthen the arm of a joint by at most their total distance from zero.
std::vector<double> armsAtRest(const KinematicModel& model, int body, const Eigen::Vector3d& center,
                               double radius);

/// Lever arms that are linear in the slides of the prismatic joints, for bounds that must be fast.
struct RestArms {
  std::vector<double> arms;  ///< m, per joint of the path, with all prismatic joints at zero
  /// Growth of the lever arm of joint `path[joint]` per m that joint `slide` is off zero.
  struct Growth {
    std::size_t joint = 0;
    int slide = 0;  ///< index into KinematicModel::bodies
    double share = 0.0;
  };
  std::vector<Growth> growths;
};

RestArms restArms(const KinematicModel& model, int body, const Eigen::Vector3d& center,
                  double radius);

/// Bounds over a whole motion, for every point of the ball, relative to an ancestor body (path
/// index `first` is the first joint that counts).
struct PointMotionBound {
  double speed = 0.0;         ///< m per unit t
  double acceleration = 0.0;  ///< m per unit t squared
};

/// `arms`: lever arms over the motion, of the joints of `path`.
PointMotionBound pointMotionBound(const KinematicModel& model, std::span<const int> path,
                                  std::span<const double> arms, std::size_t first,
                                  std::span<const JointMotion> motion);
}  // namespace swept::detail
