// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "kinematics/motion_model.hpp"

namespace swept::detail {

class StraightPath;

/// The values of a model's joints over a motion, t in [0, 1]. Both tiers know a motion only through
/// this.
///
/// The values must be continuously differentiable over [0, 1], and their rates Lipschitz
/// continuous: a path with a corner is two motions.
class JointPath {
 public:
  virtual ~JointPath() = default;

  /// Writes each joint's motion on I = [t - half, t + half], within [0, 1], into `joints`, by body:
  /// value and rate at `t`; the range of the value, and bounds on rate and acceleration, over I.
  /// The bound on the acceleration has what rounding takes of the rate at `t`, over I. If a joint's
  /// rate is constant over all of [0, 1], value and rate may be those at another time
  /// (JointMotion::anchor). `joints` may be shorter than KinematicModel::bodies; the rest is left
  /// out.
  ///
  /// False if a value is not finite, a quaternion is zero, or a prismatic value is outside its
  /// limits. If it is true for t = half = 1/2, it must be true for all other intervals.
  virtual bool linearize(double t, double half, std::span<JointMotion> joints) const = 0;

  /// Writes the configuration at t into `q`. At 0 and 1 it is the one that the path was made from.
  virtual void interpolate(double t, std::span<double> q) const = 0;

  /// Null unless the path is a straight one.
  virtual const StraightPath* asStraight() const { return nullptr; }

 protected:
  JointPath() = default;
  JointPath(const JointPath&) = default;
  JointPath& operator=(const JointPath&) = default;
};

/// JointPath::linearize for an interval of a path that returned true for the whole. Throws
/// std::logic_error if the path now returns false: no bound would hold.
void linearizePart(const JointPath& path, double t, double half, std::span<JointMotion> joints);

/// Values that are linear in t; cyclic ones go the shorter way, orientations by slerp.
class StraightPath final : public JointPath {
 public:
  /// The model and the configurations must outlive this.
  StraightPath(const KinematicModel& model, std::span<const double> from,
               std::span<const double> to)
      : model_(&model), from_(from), to_(to) {}

  bool linearize(double t, double half, std::span<JointMotion> joints) const override;
  void interpolate(double t, std::span<double> q) const override;
  const StraightPath* asStraight() const override { return this; }

  std::span<const double> from() const { return from_; }
  std::span<const double> to() const { return to_; }

 private:
  const KinematicModel* model_;
  std::span<const double> from_, to_;
};

/// A part [begin, end] of a path of the robot's joints, beside obstacles that move straight.
class PathSegment final : public JointPath {
 public:
  /// `from` and `to`: full configurations, from which the obstacles' part is read. All must outlive
  /// this.
  PathSegment(const KinematicModel& model, const JointPath& path, double begin, double end,
              std::span<const double> from, std::span<const double> to)
      : model_(&model), path_(&path), begin_(begin), end_(end), from_(from), to_(to) {}

  bool linearize(double t, double half, std::span<JointMotion> joints) const override;
  void interpolate(double t, std::span<double> q) const override;

 private:
  const KinematicModel* model_;
  const JointPath* path_;
  double begin_, end_;
  std::span<const double> from_, to_;
};

}  // namespace swept::detail
