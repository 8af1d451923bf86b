// SPDX-License-Identifier: BSD-3-Clause
#include "completion/robot_names.hpp"

#include <tinyxml2.h>

#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include "input/task.hpp"
#include "input/work_cells.hpp"

namespace swept {
namespace {

using tinyxml2::XMLElement;

/// Larger ones take longer than someone waits who has pressed a key.
constexpr std::uintmax_t kMostBytes = std::uintmax_t{32} * 1024 * 1024;

/// Empty where there is nothing to read; a pipe would wait for its writer.
std::string textOf(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return {};
  if (std::filesystem::file_size(file, error) > kMostBytes || error) return {};
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

struct Texts {
  std::string urdf, srdf;
};

/// Empty where they cannot be read: whoever presses a key wants no message.
Texts textsOf(const Arguments& args) {
  if (!isWorkCell(args)) return {textOf(args.robot), textOf(chooseSrdf(args).file)};
  try {
    ComposedRobot cell = compose(WorkCell::read(args.robot));
    return {std::move(cell.urdf), std::move(cell.srdf)};
  } catch (const std::exception&) {
    return {};
  }
}

std::string attribute(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

/// Calls `take` with the name of each child of <robot> that is an `element`.
template <typename Take>
void forEach(tinyxml2::XMLDocument& document, const char* element, Take take) {
  const XMLElement* robot = document.FirstChildElement("robot");
  if (robot == nullptr) return;
  for (const XMLElement* child = robot->FirstChildElement(element); child != nullptr;
       child = child->NextSiblingElement(element))
    take(*child, attribute(*child, "name"));
}

}  // namespace

RobotNames robotNames(const Arguments& args) {
  RobotNames names;
  tinyxml2::XMLDocument urdf, srdf;
  const Texts texts = textsOf(args);
  urdf.Parse(texts.urdf.c_str());
  forEach(urdf, "link",
          [&](const XMLElement&, const std::string& name) { names.links.push_back(name); });
  forEach(urdf, "joint", [&](const XMLElement& joint, const std::string& name) {
    if (attribute(joint, "type") != "fixed") names.joints.push_back(name);
  });
  srdf.Parse(texts.srdf.c_str());
  forEach(srdf, "group",
          [&](const XMLElement&, const std::string& name) { names.groups.push_back(name); });
  forEach(srdf, "group_state", [&](const XMLElement& state, const std::string& name) {
    names.states.push_back({.group = attribute(state, "group"), .name = name});
  });
  if (names.groups.empty() && !names.links.empty()) names.groups.emplace_back("all");
  return names;
}

}  // namespace swept
