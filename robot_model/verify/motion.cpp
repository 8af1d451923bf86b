// SPDX-License-Identifier: BSD-3-Clause
#include "motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swept::verify {
namespace {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

double shorterWay(double from, double to) {
  const double difference = to - from;
  return std::abs(difference) <= kPi ? difference : std::remainder(difference, 2.0 * kPi);
}

const Joint* jointAbove(const Model& model, int link) {
  const int joint = link < 0 ? -1 : model.jointOf[static_cast<std::size_t>(link)];
  return joint < 0 ? nullptr : &model.joints[static_cast<std::size_t>(joint)];
}

int parentOf(const Model& model, int link) {
  const Joint* joint = jointAbove(model, link);
  return joint == nullptr ? -1 : joint->parent;
}

Quaterniond orientation(const double* xyzw, const std::string& joint) {
  const Quaterniond turn(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  if (!(turn.norm() > 1e-6 && std::isfinite(turn.norm())))
    throw Refusal("joint " + joint + ": a quaternion has no direction");
  return turn.normalized();
}

}  // namespace

bool isMoved(const Model& model, int link, int reference) {
  for (; link != reference && link >= 0; link = parentOf(model, link)) {
    const Joint* joint = jointAbove(model, link);
    if (joint != nullptr && joint->variable >= 0 && joint->kind != JointKind::Fixed) return true;
  }
  return false;
}

int commonAncestor(const Model& model, int a, int b) {
  // Parents have smaller indices than their children, and the model frame has -1.
  while (a != b) (a > b ? a : b) = parentOf(model, std::max(a, b));
  return a;
}

Motion::Motion(const Model& model, std::span<const double> from, std::span<const double> to)
    : model_(model) {
  for (const Joint& joint : model.joints) {
    const std::span<const double> held(joint.values);
    const auto first = static_cast<std::size_t>(std::max(joint.variable, 0));
    joints_.push_back(joint.variable < 0
                          ? jointMotion(joint, held, held)
                          : jointMotion(joint, from.subspan(first), to.subspan(first)));
  }
}

Motion::JointMotion Motion::jointMotion(const Joint& joint, std::span<const double> from,
                                        std::span<const double> to) const {
  JointMotion motion;
  motion.axis = joint.axis;
  switch (joint.kind) {
    case JointKind::Fixed:
      break;
    case JointKind::Revolute:
    case JointKind::Prismatic: {
      const bool cyclic =
          joint.variable >= 0 && model_.variables[static_cast<std::size_t>(joint.variable)].cyclic;
      const double start = joint.multiplier * from[0] + joint.offset;
      const double change =
          joint.multiplier * (cyclic ? shorterWay(from[0], to[0]) : to[0] - from[0]);
      // The shorter way from a small angle to a large one is small, and an offset may cancel most
      // of a large value.
      const double made =
          std::abs(joint.multiplier) * std::max(std::abs(from[0]), std::abs(to[0])) +
          std::abs(joint.offset);
      if (joint.kind == JointKind::Revolute) {
        motion.angle = start;
        motion.spin = change;
        motion.angles = made;
      } else {
        motion.translation = start * joint.axis;
        motion.rate = change * joint.axis;
        motion.lengths = made;
      }
      break;
    }
    case JointKind::Planar: {
      const Vector3d y = joint.axis.cross(joint.planarX);
      motion.translation = from[0] * joint.planarX + from[1] * y;
      motion.rate = (to[0] - from[0]) * joint.planarX + (to[1] - from[1]) * y;
      motion.angle = from[2];
      motion.spin = shorterWay(from[2], to[2]);
      motion.angles = std::max(std::abs(from[2]), std::abs(to[2]));
      motion.lengths =
          std::max(std::abs(from[0]) + std::abs(from[1]), std::abs(to[0]) + std::abs(to[1]));
      break;
    }
    case JointKind::Floating: {
      motion.translation = {from[0], from[1], from[2]};
      const Vector3d goal(to[0], to[1], to[2]);
      motion.rate = goal - motion.translation;
      motion.lengths = std::max(motion.translation.lpNorm<1>(), goal.lpNorm<1>());
      motion.rotation = orientation(from.data() + 3, joint.name);
      Quaterniond relative = orientation(to.data() + 3, joint.name) * motion.rotation.conjugate();
      const double product = from[3] * to[3] + from[4] * to[4] + from[5] * to[5] + from[6] * to[6];
      if (product < 0.0) relative.coeffs() = -relative.coeffs();
      if (const double sine = relative.vec().norm(); sine > 0.0) {
        motion.axis = relative.vec() / sine;
        motion.spin = 2.0 * std::atan2(sine, relative.w());
      }
      break;
    }
  }
  return motion;
}

Placed Motion::at(int link, int reference, double t) const {
  std::vector<std::size_t> chain;
  for (; link != reference && link >= 0; link = parentOf(model_, link)) {
    const int joint = model_.jointOf[static_cast<std::size_t>(link)];
    if (joint >= 0) chain.push_back(static_cast<std::size_t>(joint));
  }
  Placed placed;
  for (; !chain.empty(); chain.pop_back()) {
    const JointMotion& motion = joints_[chain.back()];
    const Isometry3d reference_from_joint =
        placed.reference_from_link * model_.joints[chain.back()].parent_from_joint;
    Isometry3d joint_from_child = Isometry3d::Identity();
    joint_from_child.translation() = motion.translation + t * motion.rate;
    joint_from_child.linear() =
        Eigen::AngleAxisd(motion.angle + t * motion.spin, motion.axis).toRotationMatrix() *
        motion.rotation.toRotationMatrix();
    placed.reference_from_link = reference_from_joint * joint_from_child;
    const Vector3d spin = reference_from_joint.linear() * (motion.spin * motion.axis);
    // About the child's origin, which itself moves.
    placed.angular += spin;
    placed.linear += reference_from_joint.linear() * motion.rate -
                     spin.cross(placed.reference_from_link.translation());
  }
  return placed;
}

/// A point's acceleration is the sum over all pairs of joints of the second derivatives of its
/// position, times both rates. For two joints, of which the one nearer to the reference turns about
/// a, the derivative is a x (the point's derivative by the other joint alone). It is at most the
/// other's rate times the point's distance from the other's origin, or its rate if it slides. If
/// the nearer one slides, it is zero.
Bounds Motion::bounds(int link, int reference, double reach) const {
  Bounds bounds;
  bounds.extent = reach;
  double arm = reach;  // m, from the origin of the link that the walk has come to
  double speed = 0.0;  // m per unit of time, relative to that link
  for (; link != reference && link >= 0; link = parentOf(model_, link)) {
    const int index = model_.jointOf[static_cast<std::size_t>(link)];
    if (index < 0) break;
    const JointMotion& motion = joints_[static_cast<std::size_t>(index)];
    const double spin = std::abs(motion.spin);
    bounds.acceleration += spin * (spin * arm + 2.0 * speed);
    speed += spin * arm + motion.rate.norm();
    const double offset =
        model_.joints[static_cast<std::size_t>(index)].parent_from_joint.translation().norm();
    arm += offset + std::max(motion.translation.norm(), (motion.translation + motion.rate).norm());
    bounds.extent += offset + motion.lengths;
    bounds.turn += motion.angles + 2.0 * spin;
    bounds.spin += spin;
    ++bounds.joints;
  }
  return bounds;
}

}  // namespace swept::verify
