// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "cell/composed_xml.hpp"
#include "io/mesh_store.hpp"
#include "io/srdf.hpp"
#include "io/urdf_outline.hpp"
#include "io/xml.hpp"
#include "kinematics/rigid_transform.hpp"
#include "robot/joint_types.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/did_you_mean.hpp"
#include "swept/robot_model/text_file.hpp"
#include "swept/robot_model/work_cell.hpp"
#include "text/numbers.hpp"

namespace swept {

namespace detail {

namespace {

using tinyxml2::XMLElement;

constexpr const char* kCellFrame = "world";

std::string textOf(const Eigen::Vector3d& v) {
  return formatNumber(v.x()) + " " + formatNumber(v.y()) + " " + formatNumber(v.z());
}

/// Roll, pitch and yaw (rad) of URDF.
Eigen::Vector3d anglesOf(const Eigen::Matrix3d& rotation) {
  return rotation.eulerAngles(2, 1, 0).reverse();
}

std::string nearOf(const std::string& name, const std::set<std::string>& known) {
  return didYouMean(name, std::vector<std::string>(known.begin(), known.end()));
}

/// A robot of the cell, as its files have it.
struct ReadRobot {
  std::string prefix;  ///< of its names
  UrdfOutline urdf;
  SrdfDocument srdf;
  std::string root;                 ///< link
  std::vector<std::string> joints;  ///< with values of their own, composed names
};

/// The elements that say where the joints of a named state are.
using StateElements = std::vector<const XMLElement*>;

class Composer {
 public:
  Composer(const WorkCell& cell, const LoadOptions& options)
      : cell_(cell),
        messages_(cell.file.empty() ? "work cell" : cell.file),
        options_(options),
        urdf_(cell.name),
        srdf_(cell.name) {
    // What is to be said is said when the whole is loaded.
    options_.warn = {};
    options_.warnOfUnchecked = {};
  }

  ComposedRobot run() {
    if (cell_.robots.empty()) fail(0, "a work cell needs a robot at least");
    urdf_.add("link", {messages_, 0}).SetAttribute("name", kCellFrame);
    for (const CellRobot& robot : cell_.robots) addRobot(robot);
    addCellGroups();
    ComposedXml::Text urdf = urdf_.print(), srdf = srdf_.print();
    return {.name = messages_,
            .urdf = std::move(urdf.text),
            .srdf = std::move(srdf.text),
            .urdfLines = std::move(urdf.lines),
            .srdfLines = std::move(srdf.lines)};
  }

 private:
  [[noreturn]] void fail(int line, const std::string& message) const {
    throw InputError(messages_, line, message);
  }

  ///@{
  /// One robot.
  void addRobot(const CellRobot& given) {
    requireName(given);
    const std::string owner = "robot '" + given.name + "'";
    if (!isRigid(given.parent_from_robot)) fail(given.line, owner + ": its pose must be rigid");
    if (!given.parent.empty() && !links_.contains(given.parent))
      fail(given.line, owner + ": parent '" + given.parent +
                           "' is no link of a robot before it; links are called ROBOT/LINK" +
                           nearOf(given.parent, links_));
    ReadRobot robot{.prefix = given.name + "/", .urdf = {}, .srdf = {}, .root = {}, .joints = {}};
    addUrdf(given, robot);
    if (!given.srdf.empty()) addSrdf(given, robot);
    mount(given, robot);
    addWholeGroup(given, robot);
    for (const UrdfOutline::Link& link : robot.urdf.links) links_.insert(robot.prefix + link.name);
  }

  void requireName(const CellRobot& robot) {
    const auto isAllowed = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
             c == '_' || c == '-' || c == '.';
    };
    if (robot.name.empty() || robot.name == kCellFrame ||
        !std::ranges::all_of(robot.name, isAllowed))
      fail(robot.line, "robot '" + robot.name +
                           "': a name must be of letters, digits, '_', '-' and '.', and not '" +
                           kCellFrame + "'");
    if (!names_.insert(robot.name).second)
      fail(robot.line, "a second robot is named '" + robot.name + "'");
  }

  void addUrdf(const CellRobot& given, ReadRobot& robot) {
    const std::string text = readTextFile(given.urdf);
    const InputSource source(given.urdf.string(), options_);
    robot.urdf = outlineUrdf(text, source);
    requireMeshes(robot.urdf, source);
    std::set<std::string> children;
    for (const UrdfOutline::Joint& joint : robot.urdf.joints) {
      children.insert(joint.child);
      if (valueCount(joint.type) > 0 && !joint.mimic)
        robot.joints.push_back(robot.prefix + joint.name);
    }
    robot.root = std::ranges::find_if(robot.urdf.links, [&](const UrdfOutline::Link& link) {
                   return !children.contains(link.name);
                 })->name;
    XmlFile xml(text, source);
    for (const XMLElement* e = xml.robot().FirstChildElement(); e != nullptr;
         e = e->NextSiblingElement()) {
      const std::string_view name = e->Name();
      if (name != "link" && name != "joint" && name != "material") continue;
      XMLElement& copy = urdf_.copy(*e, source.name());
      prefixAttribute(copy, "name", robot.prefix);
      if (name == "link") adaptLink(copy, robot, source);
      if (name == "joint") adaptJoint(copy, robot);
    }
  }

  /// A reference that names no file is an error of the robot's file, where it is relative to.
  static void requireMeshes(const UrdfOutline& urdf, const InputSource& source) {
    std::vector<MeshReference> references;
    for (const UrdfOutline::Link& link : urdf.links)
      for (const UrdfOutline::Collision& collision : link.collisions)
        if (!collision.mesh.empty())
          references.push_back({.reference = collision.mesh,
                                .line = collision.shapeLine,
                                .owner = "link '" + link.name + "'"});
    MeshStore(source).requireFound(references);
  }

  static void adaptLink(XMLElement& link, const ReadRobot& robot, const InputSource& source) {
    for (const char* kind : {"collision", "visual"}) {
      for (XMLElement* e = link.FirstChildElement(kind); e != nullptr;
           e = e->NextSiblingElement(kind)) {
        if (XMLElement* material = e->FirstChildElement("material"))
          prefixAttribute(*material, "name", robot.prefix);
        XMLElement* const geometry = e->FirstChildElement("geometry");
        XMLElement* const mesh =
            geometry == nullptr ? nullptr : geometry->FirstChildElement("mesh");
        if (mesh == nullptr || mesh->Attribute("filename") == nullptr) continue;
        const MeshPlace place = placeOfMesh(mesh->Attribute("filename"), source);
        if (place.problem.empty()) mesh->SetAttribute("filename", place.file.string().c_str());
      }
    }
  }

  static void adaptJoint(XMLElement& joint, const ReadRobot& robot) {
    for (const auto& [child, attribute] :
         {std::pair{"parent", "link"}, {"child", "link"}, {"mimic", "joint"}})
      if (XMLElement* e = joint.FirstChildElement(child))
        prefixAttribute(*e, attribute, robot.prefix);
  }

  /// The joints between the parent and the robot's root.
  void mount(const CellRobot& given, ReadRobot& robot) {
    XmlPlace place{given.parent.empty() ? std::string(kCellFrame) : given.parent,
                   robot.prefix + robot.root};
    const std::optional<SrdfDocument::VirtualJoint>& base = robot.srdf.virtualJoint;
    const bool moves = base && base->type != JointType::Fixed;
    if (moves) {
      urdf_.add("link", {messages_, given.line}).SetAttribute("name", given.name.c_str());
      place.child = given.name;
    }
    XMLElement& fixed = addJoint(given.name, "fixed", place, given);
    XMLElement& origin = urdf_.add(fixed, "origin");
    origin.SetAttribute("xyz", textOf(given.parent_from_robot.translation()).c_str());
    origin.SetAttribute("rpy", textOf(anglesOf(given.parent_from_robot.linear())).c_str());
    if (!moves) return;
    if (base->child != robot.root)
      throw InputError(given.srdf.string(), base->line,
                       "virtual joint '" + base->name + "': its child link must be the root '" +
                           robot.root + "', not '" + base->child + "'");
    const bool planar = base->type == JointType::Planar;
    XMLElement& moving = addJoint(robot.prefix + base->name, planar ? "planar" : "floating",
                                  {given.name, robot.prefix + robot.root}, given);
    if (planar) urdf_.add(moving, "axis").SetAttribute("xyz", "0 0 1");
    robot.joints.insert(robot.joints.begin(), robot.prefix + base->name);
  }

  struct XmlPlace {
    std::string parent, child;
  };
  XMLElement& addJoint(const std::string& name, const char* type, const XmlPlace& place,
                       const CellRobot& given) {
    XMLElement& joint = urdf_.add("joint", {messages_, given.line});
    joint.SetAttribute("name", name.c_str());
    joint.SetAttribute("type", type);
    urdf_.add(joint, "parent").SetAttribute("link", place.parent.c_str());
    urdf_.add(joint, "child").SetAttribute("link", place.child.c_str());
    return joint;
  }

  void addSrdf(const CellRobot& given, ReadRobot& robot) {
    const std::string text = readTextFile(given.srdf);
    if (text.empty())
      throw InputError(given.srdf.string(), 1, "malformed XML: the document is empty");
    const InputSource source(given.srdf.string(), options_);
    robot.srdf = readSrdf(text, source);
    XmlFile xml(text, source);
    for (const XMLElement* e = xml.robot().FirstChildElement(); e != nullptr;
         e = e->NextSiblingElement()) {
      const std::string_view name = e->Name();
      if (name == "virtual_joint") continue;  // a joint of the URDF
      XMLElement& copy = srdf_.copy(*e, source.name());
      for (const char* attribute : {"link", "link1", "link2", "joint_name"})
        prefixAttribute(copy, attribute, robot.prefix);
      if (name == "group_state") {
        prefixAttribute(copy, "group", robot.prefix);
        prefixInner(copy, robot);
        noteState(copy);
      } else {
        prefixAttribute(copy, "name", robot.prefix);
        if (name == "group") adaptGroup(copy, robot);
      }
    }
    for (const SrdfDocument::Group& group : robot.srdf.groups)
      groups_.insert(robot.prefix + group.name);
  }

  static void prefixInner(XMLElement& element, const ReadRobot& robot) {
    for (XMLElement* e = element.FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
      for (const char* attribute : {"name", "base_link", "tip_link"})
        prefixAttribute(*e, attribute, robot.prefix);
  }

  /// A fixed virtual joint is none of the composed robot's.
  static void adaptGroup(XMLElement& group, const ReadRobot& robot) {
    prefixInner(group, robot);
    const std::optional<SrdfDocument::VirtualJoint>& base = robot.srdf.virtualJoint;
    if (!base || base->type != JointType::Fixed) return;
    XMLElement* e = group.FirstChildElement("joint");
    while (e != nullptr) {
      XMLElement* const next = e->NextSiblingElement("joint");
      if (e->Attribute("name", (robot.prefix + base->name).c_str()) != nullptr)
        group.DeleteChild(e);
      e = next;
    }
  }

  void noteState(const XMLElement& state) {
    const char* const group = state.Attribute("group");
    const char* const name = state.Attribute("name");
    StateElements& joints = states_[group][name];
    for (const XMLElement* e = state.FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
      joints.push_back(e);
  }

  /// All of the robot: as a program may want to say that all of it stands. None of one that does.
  void addWholeGroup(const CellRobot& given, const ReadRobot& robot) {
    if (robot.joints.empty()) return;
    XMLElement& group = srdf_.add("group", {messages_, given.line});
    group.SetAttribute("name", given.name.c_str());
    for (const std::string& joint : robot.joints)
      srdf_.add(group, "joint").SetAttribute("name", joint.c_str());
    groups_.insert(given.name);
  }
  ///@}

  ///@{
  /// Groups across robots.
  void addCellGroups() {
    if (!cell_.groups.empty()) {
      for (const CellGroup& group : cell_.groups) addCellGroup(group);
      return;
    }
    CellGroup all{.name = "all", .groups = {}};
    for (const CellRobot& robot : cell_.robots)
      if (groups_.contains(robot.name)) all.groups.push_back(robot.name);
    if (!all.groups.empty()) addCellGroup(all);
  }

  void addCellGroup(const CellGroup& given) {
    const std::string owner = "group '" + given.name + "'";
    if (given.name.empty()) fail(given.line, "a group must have a name");
    if (given.groups.empty()) fail(given.line, owner + " must list a group of a robot at least");
    for (const std::string& member : given.groups)
      if (!groups_.contains(member))
        fail(given.line, owner + ": '" + member + "' is no group of the cell's robots" +
                             nearOf(member, groups_));
    if (!groups_.insert(given.name).second)
      fail(given.line, "a second group is named '" + given.name + "'");
    XMLElement& group = srdf_.add("group", {messages_, given.line});
    group.SetAttribute("name", given.name.c_str());
    for (const std::string& member : given.groups)
      srdf_.add(group, "group").SetAttribute("name", member.c_str());
    for (const auto& [state, joints] : statesOfAll(given.groups)) {
      XMLElement& added = srdf_.add("group_state", {messages_, given.line});
      added.SetAttribute("name", state.c_str());
      added.SetAttribute("group", given.name.c_str());
      for (const XMLElement* joint : joints) {
        XMLElement& own = srdf_.add(added, "joint");
        for (const char* attribute : {"name", "value"})
          own.SetAttribute(attribute, joint->Attribute(attribute));
      }
      states_[given.name][state] = joints;
    }
  }

  std::map<std::string, StateElements> statesOfAll(const std::vector<std::string>& groups) {
    std::map<std::string, StateElements> common = states_[groups.front()];
    for (const std::string& group : std::span(groups).subspan(1)) {
      const std::map<std::string, StateElements>& own = states_[group];
      std::erase_if(common, [&](const auto& state) { return !own.contains(state.first); });
      for (auto& [name, joints] : common)
        joints.insert(joints.end(), own.at(name).begin(), own.at(name).end());
    }
    return common;
  }
  ///@}

  const WorkCell& cell_;
  const std::string messages_;
  LoadOptions options_;
  ComposedXml urdf_, srdf_;
  std::set<std::string> names_;   ///< of robots
  std::set<std::string> links_;   ///< composed, of the robots before
  std::set<std::string> groups_;  ///< composed
  std::map<std::string, std::map<std::string, StateElements>> states_;  ///< by group, by name
};

/// Of messages about a composed text: what they say about the texts it was made of.
class Origins {
 public:
  explicit Origins(const ComposedRobot& composed) : composed_(composed) {}

  static std::string nameOf(const ComposedRobot& composed, const char* kind) {
    return composed.name + " (composed " + kind + ")";
  }

  InputError of(const InputError& error) const {
    const LineOrigin* const origin = find(error.file(), error.line());
    return origin == nullptr ? error : InputError(origin->file, origin->line, error.message());
  }

  /// `NAME:LINE: warning: ...`
  std::string of(const std::string& remark) const {
    for (const char* kind : kKinds) {
      const std::string name = nameOf(composed_, kind);
      if (!remark.starts_with(name + ":")) continue;
      const std::string rest = remark.substr(name.size() + 1);
      const std::size_t end = rest.find(':');
      const LineOrigin* const origin = find(name, std::atoi(rest.c_str()));
      if (end == std::string::npos || origin == nullptr) return remark;
      const std::string place =
          origin->line > 0 ? origin->file + ":" + std::to_string(origin->line) : origin->file;
      return place + rest.substr(end);
    }
    return remark;
  }

  static constexpr const char* kUrdf = "URDF";
  static constexpr const char* kSrdf = "SRDF";

 private:
  static constexpr std::array kKinds{kUrdf, kSrdf};

  const LineOrigin* find(const std::string& file, int line) const {
    for (const char* kind : kKinds) {
      const std::vector<LineOrigin>& lines =
          kind == kUrdf ? composed_.urdfLines : composed_.srdfLines;
      if (file == nameOf(composed_, kind) && line > 0 &&
          static_cast<std::size_t>(line) <= lines.size())
        return &lines[static_cast<std::size_t>(line) - 1];
    }
    return nullptr;
  }

  const ComposedRobot& composed_;
};

}  // namespace

}  // namespace detail

ComposedRobot compose(const WorkCell& cell, const LoadOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return compose(cell, options); });
  }
  return detail::Composer(cell, options).run();
}

std::shared_ptr<const Robot> loadComposed(const ComposedRobot& composed,
                                          const LoadOptions& options) {
  using detail::Origins;
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return loadComposed(composed, options); });
  }
  const Origins origins(composed);
  LoadOptions own = options;
  const auto translated = [&](const std::function<void(const std::string&)>& taker) {
    return [&](const std::string& remark) { taker(origins.of(remark)); };
  };
  if (options.warn) own.warn = translated(options.warn);
  if (options.warnOfUnchecked) own.warnOfUnchecked = translated(options.warnOfUnchecked);
  try {
    return Robot::parse(composed.urdf, Origins::nameOf(composed, Origins::kUrdf), composed.srdf,
                        Origins::nameOf(composed, Origins::kSrdf), own);
  } catch (const InputError& error) {
    throw origins.of(error);
  }
}

std::shared_ptr<const Robot> loadWorkCell(const WorkCell& cell, const LoadOptions& options) {
  return loadComposed(compose(cell, options), options);
}

}  // namespace swept
