// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <utility>

#include "io/urdf_elements.hpp"
#include "robot/joint_types.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

constexpr std::array<std::pair<std::string_view, JointType>, 6> kJointTypes{
    {{"revolute", JointType::Revolute},
     {"continuous", JointType::Continuous},
     {"prismatic", JointType::Prismatic},
     {"fixed", JointType::Fixed},
     {"floating", JointType::Floating},
     {"planar", JointType::Planar}}};

}  // namespace

UrdfOutline::Joint UrdfJointReader::read(Element& element) {
  UrdfOutline::Joint joint;
  joint.name = xml_.text(element, "name", "");
  joint.line = element.GetLineNum();
  const std::string owner = "joint '" + joint.name + "'";
  joint.type = readType(element, owner);
  reduce(element, {"origin", "parent", "child", "axis", "limit", "mimic"},
         {"dynamics", "calibration", "safety_controller", "hardwareInterface"}, owner);
  const Element* parent = xml_.onlyChild(element, "parent", owner);
  if (parent == nullptr) xml_.fail(element, owner + " has no <parent>");
  refuseUnknownAttributes(*parent, {"link"}, owner);
  joint.parent = xml_.text(*parent, "link", owner);
  const Element* child = xml_.onlyChild(element, "child", owner);
  if (child == nullptr) xml_.fail(element, owner + " has no <child>");
  refuseUnknownAttributes(*child, {"link"}, owner);
  joint.child = xml_.text(*child, "link", owner);
  readOrigin(element, owner);
  readAxis(element, joint.type, owner);
  readLimit(element, joint.type, owner);
  readMimic(element, joint, owner);
  return joint;
}

JointType UrdfJointReader::readType(const Element& element, const std::string& owner) {
  const std::string type = xml_.text(element, "type", owner);
  for (const auto& [name, value] : kJointTypes) {
    if (name == type) return value;
  }
  xml_.fail(element,
            owner + " has the unknown type '" + type +
                "'; allowed are revolute, continuous, prismatic, fixed, floating and planar");
}

void UrdfJointReader::readAxis(Element& joint, JointType type, const std::string& owner) {
  Element* axis = xml_.onlyChild(joint, "axis", owner);
  if (axis == nullptr) {
    // URDF's axis is then x, also as a plane's normal. MoveIt moves planar joints in x and y.
    if (type == JointType::Planar)
      xml_.source().warn(joint.GetLineNum(),
                         owner +
                             " is planar and has no <axis>: it moves in the plane normal to "
                             "the x axis, which URDF takes then");
    return;
  }
  if (!hasAxis(type)) {
    joint.DeleteChild(axis);  // the axis has no meaning there, and exporters write zeros
    return;
  }
  // Old files have zeros there. Another angle may be meant to turn the axis, which no reader does.
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  if (xml_.vector(*axis, "rpy", owner, zero) == zero) axis->DeleteAttribute("rpy");
  refuseUnknownAttributes(*axis, {"xyz"}, owner);
  const Eigen::Vector3d value = xml_.vector(*axis, "xyz", owner, Eigen::Vector3d::UnitX());
  const double largest = value.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) {
    xml_.fail(*axis, XmlFile::quote(*axis, "xyz") + " of " + owner + " must not be zero");
  }
  // Scaled first: the squares of very small or large components would underflow or overflow.
  setVector(*axis, "xyz", (value / largest).normalized());
}

void UrdfJointReader::readLimit(Element& joint, JointType type, const std::string& owner) {
  Element* limit = xml_.onlyChild(joint, "limit", owner);
  const bool bounded = hasLimits(type);
  if (limit == nullptr) {
    if (bounded)
      xml_.fail(joint, owner + " has no <limit>; revolute and prismatic joints need one");
    return;
  }
  refuseUnknownAttributes(
      *limit,
      {"lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk", "damping",
       "friction", "command_effort", "current", "gear_velocity"},
      owner);
  const double lower = xml_.number(*limit, "lower", owner, 0.0);
  const double upper = xml_.number(*limit, "upper", owner, 0.0);
  setNumber(*limit, "effort", xml_.number(*limit, "effort", owner, 0.0));
  setNumber(*limit, "velocity", std::abs(xml_.number(*limit, "velocity", owner, 0.0)));
  if (!bounded) {
    // Of a continuous joint, the velocity alone has a meaning; of others without limits, nothing.
    if (turns(type)) {
      limit->DeleteAttribute("lower");
      limit->DeleteAttribute("upper");
    } else {
      joint.DeleteChild(limit);
    }
    return;
  }
  if (!(lower <= upper)) {
    xml_.fail(*limit, "<limit> of " + owner + " has lower " + formatNumber(lower) +
                          " above upper " + formatNumber(upper));
  }
  if (limit->Attribute("lower") == nullptr && limit->Attribute("upper") == nullptr) {
    xml_.source().warn(
        limit->GetLineNum(),
        "<limit> of " + owner + " has neither lower nor upper: the joint cannot move");
  }
  setNumber(*limit, "lower", lower);
  setNumber(*limit, "upper", upper);
}

void UrdfJointReader::readMimic(Element& joint, UrdfOutline::Joint& outline,
                                const std::string& owner) {
  Element* mimic = xml_.onlyChild(joint, "mimic", owner);
  if (mimic == nullptr) return;
  refuseUnknownAttributes(*mimic, {"joint", "multiplier", "offset"}, owner);
  const std::string target = xml_.text(*mimic, "joint", owner);
  setNumber(*mimic, "multiplier", xml_.number(*mimic, "multiplier", owner, 1.0));
  setNumber(*mimic, "offset", xml_.number(*mimic, "offset", owner, 0.0));
  if (valueCount(outline.type) > 1) {
    xml_.fail(*mimic, owner + " cannot mimic: only revolute, continuous and prismatic joints can");
  }
  if (valueCount(outline.type) == 0) {
    xml_.source().warn(mimic->GetLineNum(), owner + " is fixed: its <mimic> is ignored");
    joint.DeleteChild(mimic);
    return;
  }
  outline.mimic = UrdfOutline::Mimic{target, mimic->GetLineNum()};
}

}  // namespace swept::detail
