// SPDX-License-Identifier: BSD-3-Clause
#include "io/urdf_outline.hpp"

#include "io/urdf_elements.hpp"

namespace swept::detail {

namespace {

using tinyxml2::XMLElement;

UrdfOutline readElements(XmlFile& xml) {
  XMLElement& robot = xml.robot();
  UrdfOutline outline;
  outline.robotName = xml.text(robot, "name", "");
  for (XMLElement* child = robot.FirstChildElement(); child != nullptr;) {
    XMLElement* next = child->NextSiblingElement();
    const std::string_view name = child->Name();
    if (name == "link") {
      outline.links.push_back(UrdfLinkReader(xml).read(*child));
    } else if (name == "joint") {
      if (outline.joints.size() == kMaxJoints) {
        xml.fail(*child, "the robot has more than " + std::to_string(kMaxJoints) +
                             " joints, which are the most that are read");
      }
      outline.joints.push_back(UrdfJointReader(xml).read(*child));
    } else if (name.starts_with("xacro:")) {
      xml.fail(*child,
               std::string("<").append(name) + "> is not expanded; run xacro on the file first");
    } else {
      robot.DeleteChild(child);
    }
    child = next;
  }
  outline.reduced = xml.print();
  return outline;
}

}  // namespace

UrdfOutline outlineUrdf(const std::string& text, const InputSource& source) {
  XmlFile xml(text, source);
  UrdfOutline outline = readElements(xml);
  checkTree(outline, source);
  checkMimics(outline, source);
  return outline;
}

}  // namespace swept::detail
