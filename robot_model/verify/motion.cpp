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

double shorterWay(double from, double to) {
  const double difference = to - from;
  constexpr double kHalf = std::numbers::pi;
  return std::abs(difference) <= kHalf ? difference : std::remainder(difference, 2.0 * kHalf);
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

/// A value that is the same all the time.
bool isConstant(const Course& course) {
  return std::ranges::all_of(course.curve.steps, [](double step) { return step == 0.0; });
}

/// Along an axis.
Curve<Vector3d> along(const Curve<double>& curve, const Vector3d& axis) {
  Curve<Vector3d> place{.degree = curve.degree, .start = curve.start * axis, .steps = {}};
  for (std::size_t k = 0; k < curve.steps.size(); ++k) place.steps[k] = curve.steps[k] * axis;
  return place;
}

/// The sum of places of one degree.
Curve<Vector3d> sum(Curve<Vector3d> a, const Curve<Vector3d>& b) {
  a.start += b.start;
  for (std::size_t k = 0; k < a.steps.size(); ++k) a.steps[k] += b.steps[k];
  return a;
}

/// How much of a tolerance is left to go before a limit, which may be `room` away or passed.
double within(double tolerance, double room) {
  return room < tolerance ? std::max(room, 0.0) : tolerance;
}

/// `pose`: of the joint in the reference frame; `place`: of the child's origin in the joint's.
Play playOf(const Joint& joint, const Isometry3d& pose, const Around<Vector3d>& place) {
  const Tolerance& tolerance = joint.tolerance;
  const Vector3d axis = pose.linear() * joint.axis;
  Play play;
  play.origin = pose * place.value;
  switch (joint.kind) {
    case JointKind::Fixed:
      break;
    case JointKind::Revolute:
      play.turn = tolerance.rotation * axis;
      break;
    case JointKind::Prismatic: {
      const double value = place.value.dot(joint.axis);
      play.axis = axis;
      play.forward = within(tolerance.translation, joint.upper - (value - place.range));
      play.backward = within(tolerance.translation, value + place.range - joint.lower);
      break;
    }
    case JointKind::Planar:
      play.turn = tolerance.rotation * axis;
      play.slideAnywhere = tolerance.translation;
      break;
    case JointKind::Floating:
      play.turnAnywhere = tolerance.rotation;
      play.slideAnywhere = tolerance.translation;
      break;
  }
  return play;
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
    const bool held = joint.variable < 0;
    const auto first = static_cast<std::size_t>(std::max(joint.variable, 0));
    const auto begin = held ? std::span<const double>(joint.values) : from.subspan(first);
    const auto end = held ? std::span<const double>(joint.values) : to.subspan(first);
    std::vector<Course> courses;
    for (std::size_t i = 0; i < valuesOf(joint.kind); ++i) {
      const bool shorter = valuesOf(joint.kind) == 1 ? !held && model.variables[first].cyclic
                                                     : joint.kind == JointKind::Planar && i == 2;
      courses.push_back(straightCourse(
          begin[i], shorter ? shorterWay(begin[i], end[i]) : end[i] - begin[i], end[i]));
    }
    joints_.push_back(jointMotion(joint, begin, end, courses));
  }
}

Motion::Motion(const Model& model, const Point& from, const Point& to)
    : model_(model),
      curved_(isCurved(from, to)),
      clock_(ClockSpan{.clock = model.clock, .from = from.time, .to = to.time}) {
  for (const Joint& joint : model.joints) {
    const bool held = joint.variable < 0;
    const auto first = static_cast<std::size_t>(std::max(joint.variable, 0));
    std::vector<Course> courses;
    for (std::size_t i = 0; i < valuesOf(joint.kind); ++i)
      courses.push_back(held ? straightCourse(joint.values[i], 0.0, joint.values[i])
                             : courseOf(from, to, first + i));
    const std::span<const double> begin(from.positions), end(to.positions), still(joint.values);
    if (curved_ && joint.kind == JointKind::Floating)
      for (std::size_t i = 3; i < courses.size(); ++i)
        if (!isConstant(courses[i]))
          throw Refusal("joint " + joint.name + ": its orientation changes on a curve");
    joints_.push_back(jointMotion(joint, held ? still : begin.subspan(first),
                                  held ? still : end.subspan(first), courses));
  }
}

Motion::JointMotion Motion::jointMotion(const Joint& joint, std::span<const double> from,
                                        std::span<const double> to,
                                        const std::vector<Course>& courses) {
  JointMotion motion;
  motion.axis = joint.axis;
  motion.courses = courses;
  switch (joint.kind) {
    case JointKind::Fixed:
      break;
    case JointKind::Revolute:
    case JointKind::Prismatic: {
      Curve<double> value = courses[0].curve;
      value.start = joint.multiplier * value.start + joint.offset;
      for (double& step : value.steps) step *= joint.multiplier;
      // The shorter way from a small angle to a large one is small, and an offset may cancel most
      // of a large value.
      const double made = std::abs(joint.multiplier) * std::max(courses[0].begin, courses[0].end) +
                          std::abs(joint.offset);
      motion.courses[0] = {.curve = value, .begin = made, .end = made};
      if (joint.kind == JointKind::Revolute) {
        motion.angle = value;
        motion.angles = made;
      } else {
        motion.place = along(value, joint.axis);
        motion.lengths = made;
      }
      break;
    }
    case JointKind::Planar: {
      const Vector3d y = joint.axis.cross(joint.planarX);
      motion.place = sum(along(courses[0].curve, joint.planarX), along(courses[1].curve, y));
      motion.angle = courses[2].curve;
      motion.angles = std::max(courses[2].begin, courses[2].end);
      motion.lengths =
          std::max(courses[0].begin + courses[1].begin, courses[0].end + courses[1].end);
      break;
    }
    case JointKind::Floating: {
      motion.place = sum(sum(along(courses[0].curve, Vector3d::UnitX()),
                             along(courses[1].curve, Vector3d::UnitY())),
                         along(courses[2].curve, Vector3d::UnitZ()));
      const Vector3d begin(courses[0].begin, courses[1].begin, courses[2].begin);
      const Vector3d end(courses[0].end, courses[1].end, courses[2].end);
      motion.lengths = std::max(begin.lpNorm<1>(), end.lpNorm<1>());
      fly(joint, from, to, motion);
      break;
    }
  }
  return motion;
}

/// The orientation of a floating joint.
void Motion::fly(const Joint& joint, std::span<const double> from, std::span<const double> to,
                 JointMotion& motion) {
  motion.rotation = orientation(from.data() + 3, joint.name);
  Quaterniond relative = orientation(to.data() + 3, joint.name) * motion.rotation.conjugate();
  const double product = from[3] * to[3] + from[4] * to[4] + from[5] * to[5] + from[6] * to[6];
  if (product < 0.0) relative.coeffs() = -relative.coeffs();
  if (const double sine = relative.vec().norm(); sine > 0.0) {
    motion.axis = relative.vec() / sine;
    motion.angle.steps[0] = 2.0 * std::atan2(sine, relative.w());
  }
}

Placed Motion::at(int link, int reference, double t, double half) const {
  std::vector<std::size_t> chain;
  for (; link != reference && link >= 0; link = parentOf(model_, link)) {
    const int joint = model_.jointOf[static_cast<std::size_t>(link)];
    if (joint >= 0) chain.push_back(static_cast<std::size_t>(joint));
  }
  Placed placed;
  for (; !chain.empty(); chain.pop_back()) {
    const Joint& joint = model_.joints[chain.back()];
    const JointMotion& motion = joints_[chain.back()];
    const Around<Vector3d> place = around(motion.place, t, half);
    const Around<double> turn = around(motion.angle, t, half);
    const Isometry3d reference_from_joint = placed.reference_from_link * joint.parent_from_joint;
    Isometry3d joint_from_child = Isometry3d::Identity();
    joint_from_child.translation() = place.value;
    joint_from_child.linear() = Eigen::AngleAxisd(turn.value, motion.axis).toRotationMatrix() *
                                motion.rotation.toRotationMatrix();
    placed.reference_from_link = reference_from_joint * joint_from_child;
    const Vector3d spin = reference_from_joint.linear() * (turn.rate * motion.axis);
    // About the child's origin, which itself moves.
    placed.angular += spin;
    placed.linear += reference_from_joint.linear() * place.rate -
                     spin.cross(placed.reference_from_link.translation());
    if (joint.tolerance.rotation > 0.0 || joint.tolerance.translation > 0.0)
      placed.plays.push_back(playOf(joint, reference_from_joint, place));
  }
  return placed;
}

/// The distance that the child's origin may have from that of the joint.
double Motion::farthest(const JointMotion& motion, const Around<Vector3d>& place) const {
  if (curved_) return place.value.norm() + place.range;
  return std::max(motion.place.start.norm(), (motion.place.start + motion.place.steps[0]).norm());
}

/// A point's acceleration is the sum over all joints of its derivative times their acceleration,
/// and over all pairs of joints of its second derivatives times both rates. For two joints, of
/// which the one nearer to the reference turns about a, the latter is a x (the point's derivative
/// by the other joint alone). It is at most the other's rate times the point's distance from the
/// other's origin, or its rate if it slides. If the nearer one slides, it is zero.
Bounds Motion::bounds(int link, int reference, double reach, double middle, double half) const {
  Bounds bounds;
  bounds.extent = reach;
  double arm = reach;  // m, from the origin of the link that the walk has come to
  double speed = 0.0;  // m per unit of u, relative to that link
  for (; link != reference && link >= 0; link = parentOf(model_, link)) {
    const int index = model_.jointOf[static_cast<std::size_t>(link)];
    if (index < 0) break;
    const Joint& joint = model_.joints[static_cast<std::size_t>(index)];
    const JointMotion& motion = joints_[static_cast<std::size_t>(index)];
    const Around<Vector3d> place = around(motion.place, middle, half);
    const Around<double> turn = around(motion.angle, middle, half);
    const double spin = half * turn.speed + joint.tolerance.rotation;
    // The spin of a floating joint turns with the error of its orientation.
    const double bend =
        half * half * turn.acceleration +
        (joint.kind == JointKind::Floating ? half * turn.speed * joint.tolerance.rotation : 0.0);
    const double slideBend = half * half * place.acceleration;
    bounds.acceleration += spin * (spin * arm + 2.0 * speed) + bend * arm + slideBend;
    speed += spin * arm + half * place.speed + joint.tolerance.translation;
    const double offset = joint.parent_from_joint.translation().norm();
    arm += offset + farthest(motion, place) + joint.tolerance.translation;
    bounds.extent += offset + motion.lengths + joint.tolerance.translation + 2.0 * slideBend;
    if (curved_) bounds.extent += 0.5 * place.speed;
    bounds.turn += motion.angles + 2.0 * turn.speed + half * turn.acceleration +
                   4.0 * joint.tolerance.rotation;
    bounds.spin += spin;
    bounds.bend += bend;
    ++bounds.joints;
  }
  bounds.speed = speed;
  return bounds;
}

}  // namespace swept::verify
