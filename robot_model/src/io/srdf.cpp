// SPDX-License-Identifier: BSD-3-Clause
#include "io/srdf.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>

#include "io/xml.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

using tinyxml2::XMLElement;

/// Elements of srdfdom, HPP and Pinocchio without meaning for links, pairs or groups: end
/// effectors, grasps, contacts of feet, motors, coarse models.
constexpr std::array kWithoutMeaning{
    "end_effector", "link_sphere_approximation", "gripper", "handle", "contact", "rotor_params",
    "specificities"};

class SrdfReader {
 public:
  explicit SrdfReader(XmlFile& xml) : xml_(xml) {}
  SrdfDocument read();

 private:
  void readVirtualJoint(const XMLElement& element);
  SrdfDocument::Group readGroup(const XMLElement& element);
  SrdfDocument::State readState(const XMLElement& element);
  SrdfDocument::Pair readPair(const XMLElement& element);
  SrdfDocument::JointProperty readProperty(const XMLElement& element);
  SrdfDocument::Name readName(const XMLElement& element, const std::string& owner) {
    requireKnown(element, {"name"});
    return {nameIn(element, "name", owner), element.GetLineNum()};
  }
  /// srdfdom strips blanks around names.
  std::string nameIn(const XMLElement& element, const char* attribute, const std::string& owner) {
    const std::string text = xml_.text(element, attribute, owner);
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos)
      xml_.fail(element, XmlFile::quote(element, attribute) + " must not be blank");
    return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
  }
  /// Refuses other attributes.
  void requireKnown(const XMLElement& element, std::initializer_list<std::string_view> known) const;
  /// Refuses children of an element that must be empty.
  void requireEmpty(const XMLElement& element) const {
    if (const XMLElement* inner = element.FirstChildElement()) refuse(*inner, element.Name());
  }
  [[noreturn]] void refuse(const XMLElement& element, const std::string& owner) const {
    xml_.fail(element, "unknown element <" + std::string(element.Name()) + "> in <" + owner + ">");
  }

  XmlFile& xml_;
  SrdfDocument document_;
};

SrdfDocument SrdfReader::read() {
  XMLElement& robot = xml_.robot();
  document_.robot = {nameIn(robot, "name", ""), robot.GetLineNum()};
  for (const auto* a = robot.FirstAttribute(); a != nullptr; a = a->Next()) {
    const std::string_view name = a->Name();
    if (name != "name" && name != "version" && !name.starts_with("xmlns"))
      xml_.fail(robot, "unknown attribute '" + std::string(name) + "' of <robot>");
  }
  for (const XMLElement* e = robot.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    const std::string_view name = e->Name();
    if (name == "virtual_joint") {
      readVirtualJoint(*e);
    } else if (name == "group") {
      document_.groups.push_back(readGroup(*e));
    } else if (name == "group_state") {
      document_.states.push_back(readState(*e));
    } else if (name == "disable_collisions" || name == "enable_collisions") {
      document_.pairs.push_back(readPair(*e));
    } else if (name == "passive_joint") {
      document_.passive.push_back(readName(*e, ""));
      requireEmpty(*e);
    } else if (name == "disable_default_collisions") {
      requireKnown(*e, {"link"});
      requireEmpty(*e);
      document_.uncheckedByDefault.push_back({nameIn(*e, "link", ""), e->GetLineNum()});
    } else if (name == "joint_property") {
      document_.properties.push_back(readProperty(*e));
    } else if (std::ranges::find(kWithoutMeaning, name) == kWithoutMeaning.end()) {
      refuse(*e, "robot");
    }
  }
  return std::move(document_);
}

void SrdfReader::requireKnown(const XMLElement& element,
                              std::initializer_list<std::string_view> known) const {
  for (const auto* a = element.FirstAttribute(); a != nullptr; a = a->Next())
    if (std::ranges::find(known, a->Name()) == known.end())
      xml_.fail(element,
                "unknown attribute '" + std::string(a->Name()) + "' of <" + element.Name() + ">");
}

void SrdfReader::readVirtualJoint(const XMLElement& element) {
  SrdfDocument::VirtualJoint joint;
  requireKnown(element, {"name", "type", "parent_frame", "child_link"});
  requireEmpty(element);
  joint.name = nameIn(element, "name", "");
  joint.line = element.GetLineNum();
  const std::string owner = "virtual joint '" + joint.name + "'";
  if (document_.virtualJoint) {
    xml_.fail(element, owner + " is a second virtual joint; the root link has one parent");
  }
  joint.child = nameIn(element, "child_link", owner);
  if (const char* frame = element.Attribute("parent_frame")) joint.parentFrame = frame;
  const std::string type = nameIn(element, "type", owner);
  if (type == "fixed") {
    joint.type = JointType::Fixed;
  } else if (type == "planar") {
    joint.type = JointType::Planar;
  } else if (type == "floating") {
    joint.type = JointType::Floating;
  } else {
    xml_.fail(element, owner + " has the unknown type '" + type +
                           "'; allowed are fixed, planar and floating");
  }
  document_.virtualJoint = joint;
}

SrdfDocument::Group SrdfReader::readGroup(const XMLElement& element) {
  SrdfDocument::Group group;
  requireKnown(element, {"name"});
  group.name = nameIn(element, "name", "");
  group.line = element.GetLineNum();
  const std::string owner = "group '" + group.name + "'";
  for (const XMLElement* e = element.FirstChildElement(); e != nullptr;
       e = e->NextSiblingElement()) {
    const std::string_view name = e->Name();
    requireEmpty(*e);
    if (name == "chain") {
      requireKnown(*e, {"base_link", "tip_link"});
      group.chains.push_back(
          {nameIn(*e, "base_link", owner), nameIn(*e, "tip_link", owner), e->GetLineNum()});
    } else if (name == "joint") {
      group.joints.push_back(readName(*e, owner));
    } else if (name == "link") {
      group.links.push_back(readName(*e, owner));
    } else if (name == "group") {
      group.subgroups.push_back(readName(*e, owner));
    } else if (name != "passive_joint") {
      xml_.fail(*e, owner + ": unknown element <" + std::string(name) +
                        ">; allowed are chain, joint, link and group");
    }
  }
  return group;
}

SrdfDocument::State SrdfReader::readState(const XMLElement& element) {
  SrdfDocument::State state;
  requireKnown(element, {"name", "group"});
  state.name = nameIn(element, "name", "");
  state.line = element.GetLineNum();
  const std::string owner = "state '" + state.name + "'";
  state.group = nameIn(element, "group", owner);
  for (const XMLElement* e = element.FirstChildElement(); e != nullptr;
       e = e->NextSiblingElement()) {
    if (std::string_view(e->Name()) != "joint") refuse(*e, "group_state");
    requireKnown(*e, {"name", "value"});
    requireEmpty(*e);
    SrdfDocument::JointValue value{nameIn(*e, "name", owner),
                                   parseNumbers(xml_.text(*e, "value", owner)), e->GetLineNum()};
    if (value.values.empty()) {
      xml_.fail(*e, XmlFile::quote(*e, "value") + " of " + owner + " must be finite numbers");
    }
    state.values.push_back(std::move(value));
  }
  return state;
}

SrdfDocument::Pair SrdfReader::readPair(const XMLElement& element) {
  SrdfDocument::Pair pair;
  requireKnown(element, {"link1", "link2", "reason"});
  requireEmpty(element);
  pair.link1 = nameIn(element, "link1", "");
  pair.link2 = nameIn(element, "link2", "");
  const char* reason = element.Attribute("reason");
  pair.reason = reason != nullptr ? reason : "";
  pair.line = element.GetLineNum();
  pair.enable = std::string_view(element.Name()) == "enable_collisions";
  return pair;
}

SrdfDocument::JointProperty SrdfReader::readProperty(const XMLElement& element) {
  requireKnown(element, {"joint_name", "property_name", "value"});
  requireEmpty(element);
  return {nameIn(element, "joint_name", ""), nameIn(element, "property_name", ""),
          nameIn(element, "value", ""), element.GetLineNum()};
}

}  // namespace

SrdfDocument readSrdf(const std::string& text, const InputSource& source) {
  XmlFile xml(text, source);
  return SrdfReader(xml).read();
}

}  // namespace swept::detail
