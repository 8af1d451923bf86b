// SPDX-License-Identifier: BSD-3-Clause
// What the constraints of a case say, from the definitions: angles from entries of matrices.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "case.hpp"

namespace constraints {

namespace {

constexpr Real kPi = std::numbers::pi_v<Real>;
constexpr Real kNone = -std::numeric_limits<Real>::infinity();

Pose poseIn(const Eigen::Isometry3d& pose) {
  return {pose.linear().cast<Real>(), pose.translation().cast<Real>()};
}

Pose frameOf(const RandomRobot& robot, const swept::ConstraintFrame& frame,
             const std::vector<Real>& q) {
  const int link = frame.body.empty() ? 0 : std::atoi(frame.body.c_str() + 1);
  return robot.poseOf(link, q) * poseIn(frame.body_from_frame);
}

/// From the skew part, and near half a turn from the symmetric one.
Vec rotationVector(const Mat& r) {
  const Vec skew = Vec(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)) / 2;
  const Real sine = skew.norm();
  const Real cosine = (r.trace() - 1) / 2;
  const Real angle = std::atan2(sine, cosine);
  if (cosine > -0.9L) return sine > 1e-12L ? Vec(skew * (angle / sine)) : skew;
  const Mat square = (r + r.transpose()) / 2 - cosine * Mat::Identity();
  int most = 0;
  square.diagonal().maxCoeff(&most);
  Vec axis = square.col(most).normalized();
  if (axis.dot(skew) < 0) axis = -axis;
  return angle * axis;
}

Real distance(const swept::ConstraintRegion& region, const Vec& reference_point) {
  const Pose frame = poseIn(region.reference_from_region);
  const Vec x = frame.turn.transpose() * (reference_point - frame.place);
  const auto outside = [](Real a, Real b) {
    return std::max(a, b) <= 0 ? std::max(a, b)
                               : std::hypot(std::max(a, Real(0)), std::max(b, Real(0)));
  };
  const auto size = region.size.cast<Real>();
  switch (region.type) {
    case swept::ConstraintRegion::Type::Box:
      return outside(std::abs(x.x()) - size.x() / 2,
                     outside(std::abs(x.y()) - size.y() / 2, std::abs(x.z()) - size.z() / 2));
    case swept::ConstraintRegion::Type::Sphere:
      return x.norm() - size.x();
    case swept::ConstraintRegion::Type::Cylinder:
      break;
  }
  return outside(std::hypot(x.x(), x.y()) - size.x(), std::abs(x.z()) - size.y() / 2);
}

}  // namespace

Real excessOfJoint(const RandomRobot& robot, const swept::JointConstraint& own,
                   const std::vector<Real>& q) {
  const auto slash = own.joint.find('/');
  const auto index = static_cast<std::size_t>(std::atoi(own.joint.substr(1, slash - 1).c_str()));
  const RobotJoint& joint = robot.joints[index];
  const RobotJoint& source =
      joint.master < 0 ? joint : robot.joints[static_cast<std::size_t>(joint.master)];
  auto place = static_cast<std::size_t>(source.first);
  bool cyclic = joint.type == Type::Continuous;
  if (slash != std::string::npos) {
    const std::string name = own.joint.substr(slash + 1);
    place += name == "y" || name == "trans_y" ? 1 : name == "theta" || name == "trans_z" ? 2 : 0;
    cyclic = name == "theta";
  }
  const Real value = joint.multiplier * q[place] + joint.offset;
  Real off = value - own.position;
  if (cyclic) off = std::remainder(off, 2 * kPi);
  return std::max(off - own.above, -own.below - off);
}

Real excessOf(const RandomRobot& robot, const swept::PositionConstraint& own,
              const std::vector<Real>& q) {
  const Vec point =
      (frameOf(robot, own.reference, q).inverse() * frameOf(robot, own.frame, q)).place;
  Real least = std::numeric_limits<Real>::infinity();
  for (const swept::ConstraintRegion& region : own.regions)
    least = std::min(least, distance(region, point));
  return least;
}

Real excessOf(const RandomRobot& robot, const swept::OrientationConstraint& own,
              const std::vector<Real>& q) {
  const Mat frame = frameOf(robot, own.reference, q).turn;
  const Mat desired = frame * own.orientation.normalized().toRotationMatrix().cast<Real>();
  const Mat r = desired.transpose() * frameOf(robot, own.frame, q).turn;
  Vec angles;
  if (own.parameterization == swept::OrientationConstraint::Parameterization::EulerAngles) {
    angles = {std::atan2(-r(1, 2), r(2, 2)), std::asin(std::clamp<Real>(r(0, 2), -1, 1)),
              std::atan2(-r(0, 1), r(0, 0))};
  } else {
    angles = frame.transpose() * desired * rotationVector(r);
  }
  Real most = kNone;
  for (int i = 0; i < 3; ++i)
    if (own.tolerance[i] < std::numbers::pi)
      most = std::max(most, std::abs(angles[i]) - Real(own.tolerance[i]));
  return most;
}

Real excessOf(const RandomRobot& robot, const swept::AxisConstraint& own,
              const std::vector<Real>& q) {
  if (own.angle >= std::numbers::pi) return kNone;
  const Vec axis = frameOf(robot, own.frame, q).turn * own.axis.cast<Real>();
  const Vec direction = frameOf(robot, own.reference, q).turn * own.direction.cast<Real>();
  return std::atan2(axis.cross(direction).norm(), axis.dot(direction)) - own.angle;
}

Real excess(const Case& of, const std::vector<Real>& q) {
  Real most = kNone;
  for (const auto& own : of.constraint.joints)
    most = std::max(most, excessOfJoint(of.robot, own, q));
  for (const auto& own : of.constraint.positions) most = std::max(most, excessOf(of.robot, own, q));
  for (const auto& own : of.constraint.orientations)
    most = std::max(most, excessOf(of.robot, own, q));
  for (const auto& own : of.constraint.axes) most = std::max(most, excessOf(of.robot, own, q));
  return most;
}

}  // namespace constraints
