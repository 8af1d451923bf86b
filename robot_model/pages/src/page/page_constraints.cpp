// SPDX-License-Identifier: BSD-3-Clause
#include "page/page_constraints.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "kinematics/rigid_transform.hpp"
#include "swept/robot_model/task_constraint.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Three significant digits, without a sign of zero.
std::string briefNumber(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", number == 0.0 ? 0.0 : number);
  return text.data();
}

std::string mostText(double most) {
  return std::isinf(most) ? "any" : briefNumber(most);
}

std::string vectorText(const Vector3d& v) {
  return "(" + briefNumber(v.x()) + ", " + briefNumber(v.y()) + ", " + briefNumber(v.z()) + ")";
}

Json posesJson(const Isometry3d& pose) {
  const Eigen::Quaterniond turn(pose.linear());
  return {{"position", toJson(Vector3d(pose.translation()))},
          {"turn", toJson(std::span<const double>(turn.coeffs().data(), 4))}};
}

Json limitsJson(const Eigen::VectorXd& limits) {
  Json list = Json::array();
  for (const double limit : limits) list.push_back(finiteOrNull(limit));
  return list;
}

/// A frame of a constraint in the link that carries it; without a value: in the model frame.
struct PlacedFrame {
  std::optional<int> link;
  std::string name;
  Isometry3d link_from_frame;

  Json json() const {
    Json json = posesJson(link_from_frame);
    json["link"] = link ? Json(*link) : Json(nullptr);
    return json;
  }
  /// ` of LINK`, behind what is seen from it; empty: from the model frame.
  std::string seenFrom() const { return link ? " of " + name : ""; }
};

PlacedFrame placedFrame(const ConstraintFrame& frame, const Checker& checker) {
  PlacedFrame own{.link = std::nullopt,
                  .name = "the model frame",
                  .link_from_frame = detail::orthonormalized(frame.body_from_frame)};
  if (frame.body.empty()) return own;
  own.name = frame.body;
  const auto& attached = checker.options().attached;
  const auto carried = std::ranges::find(attached, frame.body, &AttachedBody::name);
  if (!checker.robot().findLink(frame.body) && carried != attached.end()) own.name = carried->link;
  own.link = checker.robot().findLink(own.name);
  return own;
}

Json jointConstraint(const JointConstraint& own, const Checker& checker) {
  const Robot& robot = checker.robot();
  std::optional<int> index = robot.findJoint(own.joint);
  int value = 0;
  if (!index) {
    const int variable = *robot.findVariable(own.joint);
    index = robot.variables()[static_cast<std::size_t>(variable)].joint;
    value = variable - robot.joints()[static_cast<std::size_t>(*index)].firstVariable;
  }
  const Joint& joint = robot.joints()[static_cast<std::size_t>(*index)];
  static constexpr std::array<const char*, 3> kPlanar{" in x", " in y", " in theta"};
  static constexpr std::array<const char*, 3> kFloating{" in x", " in y", " in z"};
  std::string name = "joint " + joint.name;
  if (joint.type == JointType::Planar) name += kPlanar.at(static_cast<std::size_t>(value));
  if (joint.type == JointType::Floating) name += kFloating.at(static_cast<std::size_t>(value));
  const bool turns = joint.type == JointType::Planar && value == 2;
  const bool slides = joint.type == JointType::Prismatic || joint.type == JointType::Floating ||
                      (joint.type == JointType::Planar && !turns);
  return {{"kind", "joint"},
          {"name", name},
          {"text", name + " from " + briefNumber(own.position - own.below) + " to " +
                       briefNumber(own.position + own.above)},
          {"joint", *index},
          {"value", value},
          {"cyclic", joint.type == JointType::Continuous || turns},
          {"unit", slides ? "m" : "rad"},
          {"position", own.position},
          {"above", finiteOrNull(own.above)},
          {"below", finiteOrNull(own.below)}};
}

struct RegionWords {
  const char* type;
  const char* text;
  Eigen::Index sizes;
};

RegionWords wordsOf(ConstraintRegion::Type type) {
  switch (type) {
    case ConstraintRegion::Type::Sphere:
      return {"sphere", "sphere of radius ", 1};
    case ConstraintRegion::Type::Cylinder:
      return {"cylinder", "cylinder of radius and length ", 2};
    case ConstraintRegion::Type::Box:
      break;
  }
  return {"box", "box of ", 3};
}

Json positionConstraint(const PositionConstraint& own, const Checker& checker) {
  const PlacedFrame frame = placedFrame(own.frame, checker);
  const PlacedFrame reference = placedFrame(own.reference, checker);
  std::string text =
      "point " + vectorText(frame.link_from_frame.translation()) + " of " + frame.name + " in a ";
  Json regions = Json::array();
  for (const ConstraintRegion& region : own.regions) {
    const RegionWords words = wordsOf(region.type);
    const Isometry3d pose = detail::orthonormalized(region.reference_from_region);
    if (!regions.empty()) text += " or a ";
    text += words.text;
    for (Eigen::Index k = 0; k < words.sizes; ++k)
      text += (k == 0 ? "" : " x ") + mostText(region.size[k]);
    text += " m at " + vectorText((reference.link_from_frame * pose).translation());
    Json json = posesJson(pose);
    json["type"] = words.type;
    json["size"] = limitsJson(region.size.head(words.sizes));
    regions.push_back(std::move(json));
  }
  return {{"kind", "position"},
          {"name", "position of " + frame.name},
          {"text", text + reference.seenFrom()},
          {"frame", frame.json()},
          {"reference", reference.json()},
          {"regions", std::move(regions)}};
}

Json orientationConstraint(const OrientationConstraint& own, const Checker& checker) {
  const PlacedFrame frame = placedFrame(own.frame, checker);
  const PlacedFrame reference = placedFrame(own.reference, checker);
  const bool asVector =
      own.parameterization == OrientationConstraint::Parameterization::RotationVector;
  const Eigen::Vector4d xyzw = own.orientation.normalized().coeffs();
  const std::string name = "orientation of " + frame.name;
  std::string text = name + (asVector ? " by a rotation vector" : " by angles") + " within (";
  for (Eigen::Index k = 0; k < 3; ++k) text += (k == 0 ? "" : ", ") + mostText(own.tolerance[k]);
  text += ") rad of (";
  for (Eigen::Index k = 0; k < 4; ++k) text += (k == 0 ? "" : ", ") + briefNumber(xyzw[k]);
  return {{"kind", "orientation"},
          {"name", name},
          {"text", text + ")" + reference.seenFrom()},
          {"frame", frame.json()},
          {"reference", reference.json()},
          {"turn", limitsJson(xyzw)},
          {"tolerance", limitsJson(own.tolerance)},
          {"vector", asVector}};
}

Json axisConstraint(const AxisConstraint& own, const Checker& checker) {
  const PlacedFrame frame = placedFrame(own.frame, checker);
  const PlacedFrame reference = placedFrame(own.reference, checker);
  const Vector3d axis = own.axis.normalized(), direction = own.direction.normalized();
  return {{"kind", "axis"},
          {"name", "axis of " + frame.name},
          {"text", "axis " + vectorText(frame.link_from_frame.linear() * axis) + " of " +
                       frame.name + " within " + mostText(own.angle) + " rad of " +
                       vectorText(reference.link_from_frame.linear() * direction) +
                       reference.seenFrom()},
          {"frame", frame.json()},
          {"reference", reference.json()},
          {"axis", toJson(axis)},
          {"direction", toJson(direction)},
          {"angle", finiteOrNull(own.angle)}};
}

}  // namespace

Json pageConstraintsJson(const Checker& checker) {
  const TaskConstraint& task = checker.options().constraints;
  Json list = Json::array();
  for (const JointConstraint& own : task.joints) list.push_back(jointConstraint(own, checker));
  for (const PositionConstraint& own : task.positions)
    list.push_back(positionConstraint(own, checker));
  for (const OrientationConstraint& own : task.orientations)
    list.push_back(orientationConstraint(own, checker));
  for (const AxisConstraint& own : task.axes) list.push_back(axisConstraint(own, checker));
  return list;
}

}  // namespace swept
