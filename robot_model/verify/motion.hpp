// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "course.hpp"
#include "model.hpp"

namespace swept::verify {

/// What the tolerance of a joint does to a link.
struct Play {
  Eigen::Vector3d origin =
      Eigen::Vector3d::Zero();                     ///< m, of the joint's child: turns are about it
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< rad, along the axis, either way
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< of a joint that slides
  double forward = 0.0, backward = 0.0;            ///< m, along it
  double turnAnywhere = 0.0;                       ///< rad, about any axis
  double slideAnywhere = 0.0;                      ///< m, in any direction
};

/// Pose and velocity of a link at one time: its point p has velocity linear + angular x p. All in
/// one reference frame, per unit of time.
struct Placed {
  Eigen::Isometry3d reference_from_link = Eigen::Isometry3d::Identity();
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();
  std::vector<Play> plays = {};  ///< of joints that have a tolerance
};

/// Bounds for all points of a link within `reach` of its origin, around a time m, of the way to
/// where the link may be at m + s, |s| <= half: from q(m) at u = 0 to q(m + s) + e at u = 1 by
/// q(m + u s) + u e, where no joint's e is more than its tolerance. `extent` and `turn` count the
/// sizes of the terms of lengths and angles, not of the sums: offsets may cancel most of them, and
/// the rest rounds like the whole.
struct Bounds {
  double acceleration = 0.0;  ///< m per unit of u squared, relative to the reference frame
  double extent = 0.0;        ///< m, at least the distance from the origin of the reference frame
  double turn = 0.0;          ///< rad: largest angles and multiples of all that is turned, added up
  double spin = 0.0;          ///< rad per unit of u: sum of all rotations
  double bend = 0.0;          ///< rad per unit of u squared: sum of how these change
  double speed = 0.0;         ///< m per unit of u
  int joints = 0;
};

/// The motion of a robot over a segment, t from 0 to 1. A reference frame is that of a link above,
/// or -1 for the model's.
class Motion {
 public:
  /// From one configuration to another: angles and lengths linear in t, cyclic angles the shorter
  /// way, floating orientations by slerp.
  Motion(const Model& model, std::span<const double> from, std::span<const double> to);
  /// From one point of a trajectory to the next, each value by courseOf(). Floating orientations
  /// take slerp on straight pieces. Throws Refusal where they change on a curve.
  Motion(const Model& model, const Point& from, const Point& to);

  /// At a time. The plays are those of all times within `half` of it.
  Placed at(int link, int reference, double t, double half = 0.0) const;
  Bounds bounds(int link, int reference, double reach, double middle, double half) const;
  /// The clock of what moves beside the robot. None: the motion has no times.
  const std::optional<ClockSpan>& clock() const { return clock_; }
  /// A value of a joint, in the units of its kind. The position of a floating joint has three.
  const Course& course(std::size_t joint, std::size_t value) const {
    return joints_[joint].courses[value];
  }

 private:
  /// child origin = place; orientation = turn by the angle about axis, after `rotation`. All in the
  /// joint frame.
  struct JointMotion {
    JointMotion() {
      place.start.setZero();
      place.steps.fill(Eigen::Vector3d::Zero());
    }
    Curve<Eigen::Vector3d> place;                                  ///< m
    Curve<double> angle{};                                         ///< rad
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< before the turn
    Eigen::Vector3d axis = Eigen::Vector3d::UnitX();               ///< unit
    double angles = 0.0;   ///< rad: what the angle is made of at either end, added up
    double lengths = 0.0;  ///< m: what the translation is made of at either end, added up
    std::vector<Course> courses = {};  ///< of the joint's values
  };
  static JointMotion jointMotion(const Joint& joint, std::span<const double> from,
                                 std::span<const double> to, const std::vector<Course>& courses);
  static void fly(const Joint& joint, std::span<const double> from, std::span<const double> to,
                  JointMotion& motion);
  double farthest(const JointMotion& motion, const Around<Eigen::Vector3d>& place) const;

  const Model& model_;
  bool curved_ = false;
  std::optional<ClockSpan> clock_ = {};
  std::vector<JointMotion> joints_;
};

/// Whether the group moves a link at all relative to a reference, a link above it or -1.
bool isMoved(const Model& model, int link, int reference);
/// The link nearest to both that is above, or is, each; -1: the model frame.
int commonAncestor(const Model& model, int a, int b);

}  // namespace swept::verify
