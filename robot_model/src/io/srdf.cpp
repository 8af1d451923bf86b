// SPDX-License-Identifier: BSD-3-Clause
#include "io/srdf.hpp"

#include <tinyxml2.h>

#include <string_view>

#include "io/numbers.hpp"
#include "io/xml.hpp"

namespace swept::detail {

namespace {

using tinyxml2::XMLElement;

class SrdfReader {
 public:
  explicit SrdfReader(XmlFile& xml) : xml_(xml) {}
  SrdfDocument read();

 private:
  void readVirtualJoint(const XMLElement& element);
  SrdfDocument::Group readGroup(const XMLElement& element);
  SrdfDocument::State readState(const XMLElement& element);
  SrdfDocument::Pair readPair(const XMLElement& element);
  SrdfDocument::Name readName(const XMLElement& element, const std::string& owner) {
    return {xml_.text(element, "name", owner), element.GetLineNum()};
  }

  XmlFile& xml_;
  SrdfDocument document_;
};

SrdfDocument SrdfReader::read() {
  XMLElement& robot = xml_.robot();
  document_.robot = readName(robot, "");
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
    } else if (name == "disable_default_collisions") {
      xml_.source().warn(e->GetLineNum(),
                         "<disable_default_collisions> is not supported; its pairs stay checked");
    }
  }
  return std::move(document_);
}

void SrdfReader::readVirtualJoint(const XMLElement& element) {
  SrdfDocument::VirtualJoint joint;
  joint.name = xml_.text(element, "name", "");
  joint.line = element.GetLineNum();
  const std::string owner = "virtual joint '" + joint.name + "'";
  if (document_.virtualJoint) {
    xml_.fail(element, owner + " is a second virtual joint; the root link has one parent");
  }
  joint.child = xml_.text(element, "child_link", owner);
  if (const char* frame = element.Attribute("parent_frame")) joint.parentFrame = frame;
  const std::string type = xml_.text(element, "type", owner);
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
  group.name = xml_.text(element, "name", "");
  group.line = element.GetLineNum();
  const std::string owner = "group '" + group.name + "'";
  for (const XMLElement* e = element.FirstChildElement(); e != nullptr;
       e = e->NextSiblingElement()) {
    const std::string_view name = e->Name();
    if (name == "chain") {
      group.chains.push_back(
          {xml_.text(*e, "base_link", owner), xml_.text(*e, "tip_link", owner), e->GetLineNum()});
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
  state.name = xml_.text(element, "name", "");
  state.line = element.GetLineNum();
  const std::string owner = "state '" + state.name + "'";
  state.group = xml_.text(element, "group", owner);
  for (const XMLElement* e = element.FirstChildElement("joint"); e != nullptr;
       e = e->NextSiblingElement("joint")) {
    SrdfDocument::JointValue value{xml_.text(*e, "name", owner),
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
  pair.link1 = xml_.text(element, "link1", "");
  pair.link2 = xml_.text(element, "link2", "");
  const char* reason = element.Attribute("reason");
  pair.reason = reason != nullptr ? reason : "";
  pair.line = element.GetLineNum();
  pair.enable = std::string_view(element.Name()) == "enable_collisions";
  return pair;
}

}  // namespace

SrdfDocument readSrdf(const std::string& text, const InputSource& source) {
  XmlFile xml(text, source);
  return SrdfReader(xml).read();
}

}  // namespace swept::detail
