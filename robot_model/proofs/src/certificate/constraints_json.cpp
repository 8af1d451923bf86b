// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/constraints_json.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <utility>

#include "certificate/model_json.hpp"
#include "kinematics/rigid_transform.hpp"
#include "swept/robot_model/task_constraint.hpp"

namespace swept {

Json frameJson(const ConstraintFrame& frame, const Checker& checker) {
  Json link = nullptr;
  if (!frame.body.empty()) {
    const auto& attached = checker.options().attached;
    const auto carried = std::ranges::find(attached, frame.body, &AttachedBody::name);
    const bool isLink = checker.robot().findLink(frame.body).has_value();
    link = isLink || carried == attached.end() ? frame.body : carried->link;
  }
  return {{"link", link}, {"pose", poseJson(detail::orthonormalized(frame.body_from_frame))}};
}

namespace {

/// JSON has no infinity: null.
Json sizesJson(const Eigen::VectorXd& sizes) {
  Json list = Json::array();
  for (const double size : sizes) list.push_back(finiteOrNull(size));
  return list;
}

Json jointJson(const JointConstraint& own, const Checker& checker) {
  const Robot& robot = checker.robot();
  std::optional<int> joint = robot.findJoint(own.joint);
  int value = 0;
  if (!joint) {
    const int variable = *robot.findVariable(own.joint);
    joint = robot.variables()[static_cast<std::size_t>(variable)].joint;
    value = variable - robot.joints()[static_cast<std::size_t>(*joint)].firstVariable;
  }
  const Joint& found = robot.joints()[static_cast<std::size_t>(*joint)];
  return {{"kind", "joint"},
          {"joint", found.name},
          {"value", static_cast<unsigned>(value)},
          {"cyclic",
           found.type == JointType::Continuous || (found.type == JointType::Planar && value == 2)},
          {"position", own.position},
          {"above", finiteOrNull(own.above)},
          {"below", finiteOrNull(own.below)}};
}

Json regionJson(const ConstraintRegion& region) {
  const auto [type, sizes] = [&]() -> std::pair<const char*, Eigen::Index> {
    switch (region.type) {
      case ConstraintRegion::Type::Sphere:
        return {"sphere", 1};
      case ConstraintRegion::Type::Cylinder:
        return {"cylinder", 2};
      case ConstraintRegion::Type::Box:
        break;
    }
    return {"box", 3};
  }();
  return {{"type", type},
          {"size", sizesJson(region.size.head(sizes))},
          {"pose", poseJson(detail::orthonormalized(region.reference_from_region))}};
}

Json positionJson(const PositionConstraint& own, const Checker& checker) {
  Json json = {{"kind", "position"},
               {"frame", frameJson(own.frame, checker)},
               {"reference", frameJson(own.reference, checker)},
               {"regions", Json::array()}};
  for (const ConstraintRegion& region : own.regions) json["regions"].push_back(regionJson(region));
  return json;
}

Json orientationJson(const OrientationConstraint& own, const Checker& checker) {
  using Parameterization = OrientationConstraint::Parameterization;
  const Eigen::Vector4d xyzw = own.orientation.normalized().coeffs();
  return {{"kind", "orientation"},
          {"frame", frameJson(own.frame, checker)},
          {"reference", frameJson(own.reference, checker)},
          {"orientation", sizesJson(xyzw)},
          {"tolerance", sizesJson(own.tolerance)},
          {"parameterization", own.parameterization == Parameterization::RotationVector
                                   ? "rotation_vector"
                                   : "euler_angles"}};
}

Json axisJson(const AxisConstraint& own, const Checker& checker) {
  return {{"kind", "axis"},
          {"frame", frameJson(own.frame, checker)},
          {"reference", frameJson(own.reference, checker)},
          {"axis", toJson(Eigen::Vector3d(own.axis.normalized()))},
          {"direction", toJson(Eigen::Vector3d(own.direction.normalized()))},
          {"angle", finiteOrNull(own.angle)}};
}

}  // namespace

Json constraintsJson(const Checker& checker) {
  const TaskConstraint& task = checker.options().constraints;
  Json list = Json::array();
  for (const JointConstraint& own : task.joints) list.push_back(jointJson(own, checker));
  for (const PositionConstraint& own : task.positions) list.push_back(positionJson(own, checker));
  for (const OrientationConstraint& own : task.orientations)
    list.push_back(orientationJson(own, checker));
  for (const AxisConstraint& own : task.axes) list.push_back(axisJson(own, checker));
  return list;
}

}  // namespace swept
