// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "kinematics/motion_model.hpp"

namespace swept::detail {

/// A ball rigidly attached to a body, with what bounds its points' motion.
///
/// arms[i] bounds the distance of every point of the ball from the rotation axis of joint path[i]
/// (from its centre, for a floating joint), over all configurations within the limits of prismatic
/// joints, not counting the translations of planar and floating joints. What holds for one motion
/// must not depend on the limits, which may be far wider: see motionArms.
struct LeverArms {
  std::vector<int> path;     ///< bodies from the model frame (exclusive) to the ball's, root first
  std::vector<double> arms;  ///< m
  /// A prismatic joint is behind one that turns: arms of that depend on the motion.
  bool vary = false;
  /// m, bound on the distance of every point from the origin of path[0]'s joint frame.
  double reachFromBase = 0.0;
  /// m. What the ball's place is computed from is no larger: how far its points and the frames on
  /// the way to it can be from the model frame's origin, and those beyond each frame from that one.
  /// Translations of planar and floating joints come on top.
  double span = 0.0;
  /// m. The same with prismatic joints at zero: all translations come on top. Rounding is as large
  /// as this and what the motion uses of these, however near what comes of it.
  double spanAtRest = 0.0;
  double transforms = 0.0;  ///< multiplied on the way, see FixedJointChain
};

LeverArms leverArms(const KinematicModel& model, int body, const Eigen::Vector3d& center,
                    double radius);

/// Of the same ball: arms over one motion alone, into `arms`, one per joint of the path.
void motionArms(const KinematicModel& model, int body, const Eigen::Vector3d& center, double radius,
                std::span<const JointMotion> motion, std::span<double> arms);

/// Paths of more joints take time and room as their length does, not as its square.
inline constexpr std::size_t kLongPath = 128;

/// m, per joint of the path: arms with all prismatic joints at zero. Those beyond a joint make its
/// arm longer by no more than what they are off zero, all together.
std::vector<double> armsAtRest(const KinematicModel& model, int body, const Eigen::Vector3d& center,
                               double radius);

/// Arms that are linear in what the prismatic joints slide, for bounds that have no time for more.
struct RestArms {
  std::vector<double> arms;  ///< m, per joint of the path, with all prismatic joints at zero
  /// By how much more the arm of joint `path[joint]` grows, per m that joint `slide` is off zero.
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

/// `arms`: over the motion, of the joints of `path`.
PointMotionBound pointMotionBound(const KinematicModel& model, std::span<const int> path,
                                  std::span<const double> arms, std::size_t first,
                                  std::span<const JointMotion> motion);
}  // namespace swept::detail
