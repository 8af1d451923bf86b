// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/degrees_of_freedom.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "robot/joint_types.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept::detail {

namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Column = Eigen::Matrix<double, 6, 1>;

Quaterniond turnedBy(const Vector3d& rotation, const Quaterniond& from) {
  const double angle = rotation.norm();
  if (!(angle > 0.0)) return from;
  return (Quaterniond(Eigen::AngleAxisd(angle, rotation / angle)) * from).normalized();
}

void addVariable(const Robot& robot, const Group& group, int value, DegreesOfFreedom& freedom) {
  const Variable& variable = robot.variables()[group.variables[value]];
  const Joint& joint = robot.joints()[variable.joint];
  const int place = group.variables[value] - joint.firstVariable;
  const bool rotates = isOrientation(robot, variable);
  if (rotates && place > quaternionPlace(joint.type)) {
    freedom.degreeOf.push_back(freedom.degreeOf.back());
    return;
  }
  freedom.degreeOf.push_back(static_cast<int>(freedom.degrees.size()));
  Degree degree;
  degree.variable = value;
  degree.turn = rotates;
  degree.cyclic = variable.cyclic;
  degree.slides = isLength(joint.type, place);
  if (!rotates && !variable.cyclic) {
    degree.low = variable.lower;
    degree.high = variable.upper;
  }
  freedom.degrees.insert(freedom.degrees.end(), rotates ? 3 : 1, degree);
  if (rotates) freedom.quaternions.push_back(value);
}

/// Of a joint whose body turns about an axis through `center`, and of one that slides; p is the
/// point, all in the model frame.
Column turningColumn(const Vector3d& axis, const Vector3d& center, const Vector3d& p) {
  Column column;
  column << axis.cross(p - center), axis;
  return column;
}

Column slidingColumn(const Vector3d& direction) {
  Column column;
  column << direction, Vector3d::Zero();
  return column;
}

}  // namespace

DegreesOfFreedom degreesOfFreedom(const Robot& robot, const Group& group) {
  DegreesOfFreedom freedom;
  for (std::size_t i = 0; i < group.variables.size(); ++i)
    addVariable(robot, group, static_cast<int>(i), freedom);
  return freedom;
}

std::optional<int> DegreesOfFreedom::limit(std::span<const double> lower,
                                           std::span<const double> upper) {
  for (Degree& degree : degrees) {
    if (degree.turn || degree.cyclic) continue;
    double low = lower[degree.variable], high = upper[degree.variable];
    const bool ordered = low <= high;
    if (low > degree.high && isWithin(low, degree.low, degree.high)) low = degree.high;
    if (high < degree.low && isWithin(high, degree.low, degree.high)) high = degree.low;
    degree.low = std::max(degree.low, low);
    degree.high = std::min(degree.high, high);
    if (!ordered || !(degree.low <= degree.high)) return degree.variable;
  }
  return {};
}

void DegreesOfFreedom::putInPlace(std::span<double> q) const {
  constexpr double kPi = std::numbers::pi;
  for (const Degree& degree : degrees) {
    if (degree.turn) continue;
    double& value = q[degree.variable];
    if (degree.cyclic) {
      if (std::abs(value) > kPi) value = std::remainder(value, 2.0 * kPi);
    } else {
      value = std::clamp(value, degree.low, degree.high);
    }
  }
  for (const int first : quaternions) Eigen::Map<Eigen::Vector4d>(&q[first]).normalize();
}

void DegreesOfFreedom::move(std::span<const double> from, const Eigen::VectorXd& step, double scale,
                            std::span<double> to) const {
  std::copy(from.begin(), from.end(), to.begin());
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    const Degree& degree = degrees[i];
    const double unit = degree.slides ? scale : 1.0;
    if (!degree.turn) to[degree.variable] += unit * step[static_cast<Eigen::Index>(i)];
  }
  for (const int first : quaternions) {
    const Vector3d rotation = step.segment<3>(degreeOf[first]);
    const Quaterniond before(&from[first]);
    Eigen::Map<Quaterniond> after(&to[first]);
    after = turnedBy(rotation, before);
  }
  putInPlace(to);
}

void addJointColumns(const DegreesOfFreedom& freedom, const MovingBody& body, const Matrix3d& axes,
                     const Vector3d& center, const Vector3d& point, double sign,
                     PointJacobian& jacobian) {
  const int first = freedom.degreeOf[body.variable];
  switch (body.type) {
    case JointType::Revolute:
    case JointType::Continuous:
      jacobian.col(first) +=
          turningColumn(sign * body.multiplier * (axes * body.axis), center, point);
      break;
    case JointType::Prismatic:
      jacobian.col(first) += slidingColumn(sign * body.multiplier * (axes * body.axis));
      break;
    case JointType::Planar: {
      const Matrix3d plane = sign * (axes * body.planarBasis);
      jacobian.col(first) += slidingColumn(plane.col(0));
      jacobian.col(first + 1) += slidingColumn(plane.col(1));
      jacobian.col(first + 2) += turningColumn(plane.col(2), center, point);
      break;
    }
    case JointType::Floating:
      for (int i = 0; i < 3; ++i) {
        jacobian.col(first + i) += slidingColumn(sign * axes.col(i));
        jacobian.col(first + 3 + i) += turningColumn(sign * axes.col(i), center, point);
      }
      break;
    case JointType::Fixed:
      break;
  }
}

Vector3d rotationVector(const Matrix3d& rotation) {
  Quaterniond q(rotation);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  // Half the vector is the sine if that rounds to the angle.
  if (sine < 1e-12) return 2.0 * q.vec();
  return (2.0 * std::atan2(sine, q.w()) / sine) * q.vec();
}

}  // namespace swept::detail
