// SPDX-License-Identifier: BSD-3-Clause
#include "io/urdf_outline.hpp"

#include <algorithm>
#include <map>

#include "io/urdf_elements.hpp"
#include "io/zero_sizes.hpp"
#include "robot/joint_types.hpp"

namespace swept::detail {

namespace {

using tinyxml2::XMLElement;

/// Leaves out the `<mimic>` of a joint that is not there, or has not one value, as MoveIt does: the
/// joint is then its own.
void dropMimicsOfNothing(XmlFile& xml, UrdfOutline& outline,
                         const std::vector<XMLElement*>& elements) {
  std::map<std::string, JointType> types;
  for (const auto& joint : outline.joints) types.emplace(joint.name, joint.type);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    UrdfOutline::Joint& joint = outline.joints[i];
    if (!joint.mimic) continue;
    const auto target = types.find(joint.mimic->joint);
    const bool known = target != types.end();
    if (known && valueCount(target->second) == 1) continue;
    xml.source().warn(
        joint.mimic->line,
        "joint '" + joint.name + "' mimics '" + joint.mimic->joint + "', which " +
            (known ? "is no revolute, continuous or prismatic joint" : "does not exist") + ": '" +
            joint.name + "' is read as a joint of its own");
    elements[i]->DeleteChild(elements[i]->FirstChildElement("mimic"));
    joint.mimic.reset();
  }
}

UrdfOutline readElements(XmlFile& xml) {
  XMLElement& robot = xml.robot();
  UrdfOutline outline;
  outline.robotName = xml.text(robot, "name", "");
  std::vector<XMLElement*> joints;
  // The rest is for simulators, controllers and viewers.
  UrdfElements(xml).reduce(
      robot, {"link", "joint"},
      {"material", "transmission", "gazebo", "sensor", "ros2_control", "mujoco", "plugin"},
      "<robot>");
  for (XMLElement* child = robot.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (std::string_view(child->Name()) == "link") {
      outline.links.push_back(UrdfLinkReader(xml).read(*child));
      continue;
    }
    if (outline.joints.size() == kMaxJoints) {
      xml.fail(*child, "the robot has more than " + std::to_string(kMaxJoints) +
                           " joints, which are the most that are read");
    }
    outline.joints.push_back(UrdfJointReader(xml).read(*child));
    joints.push_back(child);
  }
  dropMimicsOfNothing(xml, outline, joints);
  outline.reduced = xml.print();
  return outline;
}

/// `'a', 'b' and 7 more`.
std::string namesOf(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
    text += (text.empty() ? "'" : ", '") + names[i] + "'";
  return names.size() <= kMost ? text
                               : text + " and " + std::to_string(names.size() - kMost) + " more";
}

void warnOfMissingVolume(const UrdfOutline& outline, const InputSource& source) {
  std::vector<std::string> shown, flat;
  int lineOfShown = 0, lineOfFlat = 0;
  for (const UrdfOutline::Link& link : outline.links) {
    if (link.hasVisual && link.collisions.empty()) {
      if (shown.empty()) lineOfShown = link.line;
      shown.push_back(link.name);
    }
    for (const UrdfOutline::Collision& collision : link.collisions) {
      if (!collision.withoutVolume) continue;
      if (flat.empty()) lineOfFlat = collision.shapeLine;
      if (flat.empty() || flat.back() != link.name) flat.push_back(link.name);
    }
  }
  if (!flat.empty())
    source.warn(lineOfFlat, std::string(flat.size() == 1 ? "link " : "links ") + namesOf(flat) +
                                ": " + kZeroSize);
  if (!shown.empty())
    source.warnOfUnchecked(lineOfShown,
                           std::string(shown.size() == 1 ? "link " : "links ") + namesOf(shown) +
                               (shown.size() == 1 ? " has" : " have") +
                               " a <visual> and no <collision>: nothing is checked against " +
                               (shown.size() == 1 ? "it" : "them"));
}

}  // namespace

UrdfOutline outlineUrdf(const std::string& text, const InputSource& source) {
  XmlFile xml(text, source);
  UrdfOutline outline = readElements(xml);
  checkTree(outline, source);
  checkMimics(outline, source);
  warnOfMissingVolume(outline, source);
  return outline;
}

}  // namespace swept::detail
