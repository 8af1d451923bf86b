// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/task_constraint.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include "swept/core/axis_frame.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

ConstraintFrame at(const std::string& link, const Eigen::Vector3d& point) {
  ConstraintFrame frame{.body = link};
  frame.body_from_frame.translation() = point;
  return frame;
}

TaskConstraint inRegion(const std::string& link, const Eigen::Vector3d& point,
                        const ConstraintRegion& region) {
  return {.positions = {{.frame = at(link, point), .regions = {region}}}};
}

/// About `origin`, z along `direction`.
Eigen::Isometry3d along(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  // Of a direction that is none, the checker complains about the pose.
  pose.linear() = direction.isZero(0.0) || !direction.allFinite() ? Eigen::Matrix3d::Zero()
                                                                  : axisFrame(direction);
  pose.translation() = origin;
  return pose;
}

std::string nameOf(const ConstraintFrame& frame) {
  return frame.body.empty() ? "the model frame" : "'" + frame.body + "'";
}

}  // namespace

void TaskConstraint::add(const TaskConstraint& other) {
  const auto append = [](auto& list, const auto& more) {
    list.insert(list.end(), more.begin(), more.end());
  };
  append(joints, other.joints);
  append(positions, other.positions);
  append(orientations, other.orientations);
  append(axes, other.axes);
}

TaskConstraint TaskConstraint::upright(const std::string& link, double angle,
                                       const Eigen::Vector3d& axis) {
  return {.axes = {{.frame = {.body = link}, .axis = axis, .angle = angle}}};
}

TaskConstraint TaskConstraint::level(const std::string& link,
                                     const Eigen::Isometry3d& model_from_link, double angle) {
  return upright(link, angle, model_from_link.linear().row(2));
}

TaskConstraint TaskConstraint::inside(const std::string& link, const Eigen::Vector3d& size,
                                      const Eigen::Isometry3d& model_from_box,
                                      const Eigen::Vector3d& point) {
  return inRegion(
      link, point,
      {.type = ConstraintRegion::Type::Box, .size = size, .reference_from_region = model_from_box});
}

TaskConstraint TaskConstraint::onLine(const std::string& link, const Eigen::Vector3d& origin,
                                      const Eigen::Vector3d& direction, double tolerance,
                                      const Eigen::Vector3d& point) {
  return inRegion(link, point,
                  {.type = ConstraintRegion::Type::Cylinder,
                   .size = {tolerance, kUnlimited, 0.0},
                   .reference_from_region = along(origin, direction)});
}

TaskConstraint TaskConstraint::onPlane(const std::string& link, const Eigen::Vector3d& origin,
                                       const Eigen::Vector3d& normal, double tolerance,
                                       const Eigen::Vector3d& point) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return onPlane(link, origin, normal, tolerance, point); });
  }
  return inRegion(link, point,
                  {.type = ConstraintRegion::Type::Box,
                   .size = {kUnlimited, kUnlimited, 2.0 * tolerance},
                   .reference_from_region = along(origin, normal)});
}

std::string describe(const ConstraintViolation& violation, const TaskConstraint& constraint) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return describe(violation, constraint); });
  }
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(3);
  const std::size_t i = violation.index;
  switch (violation.kind) {
    case ConstraintViolation::Kind::Joint:
      text << "joint '" << constraint.joints.at(i).joint << "' is " << violation.excess
           << " beyond its tolerance";
      break;
    case ConstraintViolation::Kind::Position:
      text << "position of " << nameOf(constraint.positions.at(i).frame) << " is "
           << violation.excess << " m outside its region";
      break;
    case ConstraintViolation::Kind::Orientation:
      text << "orientation of " << nameOf(constraint.orientations.at(i).frame) << " is "
           << violation.excess << " rad beyond its tolerance";
      break;
    case ConstraintViolation::Kind::Axis:
      text << "axis of " << nameOf(constraint.axes.at(i).frame) << " is " << violation.excess
           << " rad beyond its angle";
      break;
  }
  return text.str();
}

}  // namespace swept
