// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <string>

#include "certificate/read_checker.hpp"
#include "robot/joint_types.hpp"
#include "verify/model.hpp"

namespace swept {
namespace {

using verify::at;
using verify::readList;
using verify::readNumber;
using verify::Refusal;

const std::string kPlace = "constraints";

/// null: without limit.
double mostOf(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::infinity() : readNumber(json, kPlace);
}

template <typename Vector>
Vector limitsOf(const Json& json, const char* key) {
  const Json& list = readList(json, key, kPlace);
  Vector limits = Vector::Zero();
  if (list.size() > static_cast<std::size_t>(limits.size()))
    throw Refusal(kPlace + ": " + key + " has too many numbers");
  for (std::size_t i = 0; i < list.size(); ++i)
    limits[static_cast<Eigen::Index>(i)] = mostOf(list[i]);
  return limits;
}

ConstraintFrame frameOf(const Json& json, const char* key) {
  const Json& own = at(json, key, kPlace);
  ConstraintFrame frame;
  if (const Json& link = at(own, "link", kPlace); !link.is_null()) frame.body = link;
  frame.body_from_frame = verify::readPose(at(own, "pose", kPlace), kPlace);
  return frame;
}

JointConstraint jointConstraintOf(const Json& json, const Robot& robot) {
  const std::string name = at(json, "joint", kPlace);
  const auto index = robot.findJoint(name);
  if (!index) throw Refusal(kPlace + ": no joint " + name);
  const Joint& joint = robot.joints()[static_cast<std::size_t>(*index)];
  JointConstraint own{.joint = name};
  if (detail::valueCount(joint.type) > 1)
    own.joint = robot
                    .variables()[static_cast<std::size_t>(joint.firstVariable) +
                                 at(json, "value", kPlace).get<std::size_t>()]
                    .name;
  own.position = readNumber(at(json, "position", kPlace), kPlace);
  own.above = mostOf(at(json, "above", kPlace));
  own.below = mostOf(at(json, "below", kPlace));
  return own;
}

ConstraintRegion regionOf(const Json& json) {
  const std::string type = at(json, "type", kPlace);
  ConstraintRegion region;
  region.type = type == "sphere"     ? ConstraintRegion::Type::Sphere
                : type == "cylinder" ? ConstraintRegion::Type::Cylinder
                                     : ConstraintRegion::Type::Box;
  region.size = limitsOf<Eigen::Vector3d>(json, "size");
  region.reference_from_region = verify::readPose(at(json, "pose", kPlace), kPlace);
  return region;
}

PositionConstraint positionOf(const Json& json) {
  PositionConstraint own{
      .frame = frameOf(json, "frame"), .reference = frameOf(json, "reference"), .regions = {}};
  for (const Json& region : readList(json, "regions", kPlace))
    own.regions.push_back(regionOf(region));
  return own;
}

OrientationConstraint orientationOf(const Json& json) {
  using Parameterization = OrientationConstraint::Parameterization;
  return {.frame = frameOf(json, "frame"),
          .reference = frameOf(json, "reference"),
          .orientation = Eigen::Quaterniond(limitsOf<Eigen::Vector4d>(json, "orientation")),
          .tolerance = limitsOf<Eigen::Vector3d>(json, "tolerance"),
          .parameterization = at(json, "parameterization", kPlace) == "rotation_vector"
                                  ? Parameterization::RotationVector
                                  : Parameterization::EulerAngles};
}

AxisConstraint axisOf(const Json& json) {
  return {.frame = frameOf(json, "frame"),
          .reference = frameOf(json, "reference"),
          .axis = verify::readUnit(json, "axis", kPlace),
          .direction = verify::readUnit(json, "direction", kPlace),
          .angle = mostOf(at(json, "angle", kPlace))};
}

}  // namespace

TaskConstraint constraintsOf(const Json& list, const Robot& robot) {
  TaskConstraint task;
  for (const Json& json : list) {
    const std::string kind = at(json, "kind", kPlace);
    if (kind == "joint")
      task.joints.push_back(jointConstraintOf(json, robot));
    else if (kind == "position")
      task.positions.push_back(positionOf(json));
    else if (kind == "orientation")
      task.orientations.push_back(orientationOf(json));
    else if (kind == "axis")
      task.axes.push_back(axisOf(json));
    else
      throw Refusal(kPlace + ": no kind '" + kind + "'");
  }
  return task;
}

}  // namespace swept
